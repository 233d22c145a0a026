"""Mutated replies, more of them than hypothesis tries; `fuzz.py` is the command that tries millions."""

import numpy as np
import pytest
from fuzz import LONGEST, MUTATIONS, fuzz, growth, mutated, reading_times


def test_a_thousand_mutated_replies_are_answered():
    became = fuzz(1_000)
    assert became.total() == 1_000
    assert set(became) == {"read", "mended", "unreadable"}


@pytest.mark.slow
def test_twenty_thousand_mutated_replies_are_answered():
    assert fuzz(20_000, seed=1).total() == 20_000


def test_a_crash_is_told_with_the_reply_that_caused_it(monkeypatch):
    monkeypatch.setattr("fuzz.mutated", lambda rng: "Hello")
    monkeypatch.setattr("fuzz.parse", lambda text, skeleton: [][0])
    with pytest.raises(AssertionError) as caught:
        fuzz(3, seed=5)
    assert str(caught.value) == "reply 0 of seed 5: 'Hello'"


def test_the_same_seed_gives_the_same_replies():
    first, second = ([mutated(rng) for _ in range(50)] for rng in map(np.random.default_rng, (3, 3)))
    assert first == second


@pytest.mark.parametrize("name", MUTATIONS)
@pytest.mark.parametrize("text", ["", "a", "abcdef"])
def test_any_text_can_be_mutated(name, text):
    rng = np.random.default_rng(0)
    for start in range(len(text) + 1):
        for end in range(start, len(text) + 1):
            assert isinstance(MUTATIONS[name](text, start, end, rng), str)


@pytest.mark.slow
def test_reading_time_grows_no_faster_than_the_length():
    lengths = [LONGEST // 8, LONGEST // 4, LONGEST // 2, LONGEST]
    assert growth(lengths, reading_times(lengths, texts=40)) < 1.3  # 1 is linear, 2 is quadratic
