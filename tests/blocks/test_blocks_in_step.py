"""Towers as symbols with heights: whatever start and goal are, all are taken apart and built in step."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from llm3_blocks.in_step import in_step, tops

NAMES = ("a", "b", "c", "d", "e")
heights = st.fixed_dictionaries({name: st.sampled_from((0.03, 0.04, 0.05)) for name in NAMES})


@st.composite
def towers(draw, some: bool = False) -> dict[str, str]:
    """What each of the blocks stands on; if `some`, not all of them are mentioned."""
    below: dict[str, str] = {}
    for name in draw(st.permutations(NAMES)):
        free = ["table", *(n for n in below if n not in below.values())]
        below[name] = draw(st.sampled_from(free))
    return {n: b for n, b in below.items() if draw(st.booleans())} if some else below


@given(towers(), towers(some=True), heights)
def test_the_moves_are_possible_and_lead_to_the_goal(start, goal, heights):
    below = dict(start)
    for pick, put in zip(*[iter(in_step(start, goal, heights))] * 2, strict=True):
        (name,) = pick.objects
        assert name not in below.values()
        target = "table" if put.name == "place" else put.objects[1]
        assert target == "table" or target not in below.values()
        below[name] = target
    assert {name: below[name] for name in goal} == goal


@given(towers(), towers(), heights)
def test_nothing_stands_higher_than_what_is_taken_from_a_tower_or_put_on_one(start, goal, heights):
    below = dict(start)
    for _, put in zip(*[iter(in_step(start, goal, heights))] * 2, strict=True):
        name = put.objects[0]
        if below[name] != "table":
            assert tops(below, heights)[name] == max(tops(below, heights).values())
        below[name] = "table" if put.name == "place" else put.objects[1]
        if below[name] != "table":
            assert tops(below, heights)[name] == max(tops(below, heights).values())
