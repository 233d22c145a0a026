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
    assert check_backend(broken_backends.Echo()) == ()
    assert check_strategy(of("good")) == check_strategy(of("own task")) == ()
    assert check_timer(broken_timers.Steady()) == ()


@pytest.mark.parametrize(("kind", "fault"), PLANTED)
def test_each_fault_is_found_and_named(kind, fault):
    check, faults = CHECKS[kind]
    complaints = check(faults[fault].plugin)
    assert faults[fault].found_in(complaints), "\n".join(f"{c.rule}: {c}" for c in complaints)
