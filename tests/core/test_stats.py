"""Stats add up: a commutative monoid."""

from dataclasses import fields

import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.types import Stats

COUNTS = [field.name for field in fields(Stats) if field.name != "seconds"]
PHASES = ("model", "prepare", "plan", "apply")
whole_seconds = st.dictionaries(st.sampled_from(PHASES), st.integers(0, 1000).map(float))
stats = st.builds(Stats, **{name: st.integers(0, 10**6) for name in COUNTS}, seconds=whole_seconds)


@given(stats)
def test_nothing_spent_adds_nothing(spent):
    assert spent + Stats() == spent == Stats() + spent


@given(stats, stats)
def test_the_order_does_not_matter(one, other):
    assert one + other == other + one
    assert hash(one + other) == hash(other + one)


@given(stats, stats, stats)
def test_the_grouping_does_not_matter(a, b, c):
    assert (a + b) + c == a + (b + c)


@given(stats, stats)
def test_every_count_and_every_phase_is_added(one, other):
    total = one + other
    assert all(getattr(total, name) == getattr(one, name) + getattr(other, name) for name in COUNTS)
    assert set(total.seconds) == set(one.seconds) | set(other.seconds)
    for phase, seconds in total.seconds.items():
        assert seconds == one.seconds.get(phase, 0.0) + other.seconds.get(phase, 0.0)


def test_stats_never_change():
    spent = Stats(seconds={"model": 1.0})
    with pytest.raises(TypeError):
        spent.seconds["model"] = 2.0
    with pytest.raises(AttributeError):
        spent.llm_calls = 1
