"""Bad replies among good ones, at places or at a rate."""

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.errors import UnknownName, UsageError
from llm3.testing import REPLY_FAULTS, Faults, FaultyLLM, ScriptedLLM
from llm3.types import Context, Message, Request

REQUEST = Request((Message("user", "Plan!"),), Context("Go.", (), (), ()))
GOOD = """["go([], {'x': 1.0})"]"""


def model(faults):
    return FaultyLLM(ScriptedLLM(lambda _: GOOD), faults)


@given(st.dictionaries(st.integers(1, 8), st.sampled_from(sorted(set(REPLY_FAULTS) - {"same plan again"}))))
def test_faults_come_where_they_are_placed_and_nowhere_else(places):
    faulty = model(Faults.at(places))
    replies = [faulty.complete(REQUEST).text for _ in range(8)]
    assert [reply != GOOD for reply in replies] == [n in places for n in range(1, 9)]
    assert faulty.injected == [places.get(n) for n in range(1, 9)]


def test_a_repeated_plan_is_the_one_that_was_said_last():
    faulty = FaultyLLM(ScriptedLLM(["one", "two", "three"]), Faults.at({2: "same plan again"}))
    assert [faulty.complete(REQUEST).text for _ in range(3)] == ["one", "one", "three"]


def test_at_a_rate_every_kind_comes_as_often_as_any_other():
    faulty = model(Faults.at_rate(0.5, set(REPLY_FAULTS) - {"endless plan"}, np.random.default_rng(0)))
    for _ in range(4_000):
        faulty.complete(REQUEST)
    drawn = Counter(faulty.injected)
    assert drawn.pop(None) == pytest.approx(2_000, rel=0.1)
    assert set(drawn) == set(REPLY_FAULTS) - {"endless plan"}
    assert list(drawn.values()) == pytest.approx([200] * 10, rel=0.3)


@given(st.integers(0, 2**32))
def test_the_same_generator_gives_the_same_faults(seed):
    runs = []
    for _ in range(2):
        faulty = model(Faults.at_rate(0.5, ["NaN", "empty"], np.random.default_rng(seed)))
        runs.append([faulty.complete(REQUEST) for _ in range(10)])
    assert runs[0] == runs[1]


def test_it_speaks_for_the_backend_that_it_spoils():
    faulty = model(Faults.at({}))
    assert not faulty.is_language_model
    assert faulty.notice == "No language model is used: the replies come from a script."
    assert faulty.last_words == ""
    faulty.close()


def test_a_fault_that_is_not_a_replys_is_refused():
    with pytest.raises(UnknownName) as caught:
        model(Faults.at({2: "timeout"}))
    known = ", ".join(sorted(REPLY_FAULTS))
    assert str(caught.value) == f"unknown fault 'timeout'. Known: {known}."


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Faults.at({0: "NaN"}), "answers are counted from 1: there is no fault at 0."),
        (
            lambda: Faults.at_rate(20, ["NaN"], np.random.default_rng(0)),
            "the rate of faults must be from 0 to 1, not 20.",
        ),
        (
            lambda: Faults.at_rate(0.2, [], np.random.default_rng(0)),
            "faults at a rate need at least one kind of fault.",
        ),
    ],
)
def test_faults_that_make_no_sense_are_refused(make, sentence):
    with pytest.raises(UsageError) as caught:
        make()
    assert str(caught.value) == sentence
