"""The kit finds each fault that is planted in feedback, backends, strategies and timers, and says the likely cause."""

from __future__ import annotations

import sys

import broken_backends
import broken_feedback
import broken_strategies
import broken_timers
import pytest
from broken_strategies import of, write_package

from llm3.testing import check_backend, check_feedback, check_strategy, check_timer
from llm3.types import FailureKind
from llm3_words import synthesizers
from llm3_words.sentences import sentence_of
from llm3_words.synthesizers import Binary, Categorized, Silent

CHECKS = {
    "feedback": (check_feedback, broken_feedback.FAULTS),
    "backend": (check_backend, broken_backends.FAULTS),
    "strategy": (check_strategy, broken_strategies.FAULTS),
    "timer": (check_timer, broken_timers.FAULTS),
}
PLANTED = [(kind, name) for kind, (_, faults) in CHECKS.items() for name in faults]


@pytest.fixture(autouse=True)
def templates(tmp_path, monkeypatch):
    write_package(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, broken_strategies.PACKAGE, raising=False)


def test_what_has_no_fault_has_no_complaint():
    assert check_feedback(broken_feedback.Plain()) == ()
    assert check_feedback(broken_feedback.quoting()) == check_feedback(broken_feedback.verdict_alone()) == ()
    assert check_backend(broken_backends.Echo()) == ()
    for name in ("good", "own task", "wrapped", "nested example", "ends of ranges by name"):
        assert check_strategy(of(name)) == (), name
    assert check_timer(broken_timers.Steady()) == ()


@pytest.mark.parametrize("kind", [kind for kind in FailureKind if kind is not FailureKind.UNREADABLE_REPLY])
@pytest.mark.parametrize("nothing", ["", None])
def test_a_kind_of_failure_without_words_is_found_in_the_levels_that_ship(monkeypatch, kind, nothing):
    monkeypatch.setattr(synthesizers, "sentence_of", lambda f: nothing if f.kind is kind else sentence_of(f))
    said = [c.text for c in check_feedback(Categorized()) if c.rule == "no kind of failure is left out"]
    assert [text.startswith(f"it tells nothing of the kind {kind.value!r}, though") for text in said] == [True]
    binary = [c.text for c in check_feedback(Binary()) if c.rule == "no kind of failure is left out"]
    assert binary == ([] if kind.is_motion else said)
    assert check_feedback(Silent()) == ()


@pytest.mark.parametrize(("kind", "fault"), PLANTED)
def test_each_fault_is_found_and_named(kind, fault):
    check, faults = CHECKS[kind]
    complaints = check(faults[fault].plugin)
    assert faults[fault].found_in(complaints), "\n".join(f"{c.rule}: {c}" for c in complaints)
