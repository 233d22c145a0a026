"""Towers as symbols: whatever the start and the goal, the moves are possible and lead there."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from llm3_blocks.sequence import sequence

NAMES = ("a", "b", "c", "d", "e", "f")


@st.composite
def towers(draw, some: bool = False) -> dict[str, str]:
    """What each of the blocks stands on; if `some`, not all of them are mentioned."""
    below: dict[str, str] = {}
    for name in draw(st.permutations(NAMES)):
        free = ["table", *(n for n in below if n not in below.values())]
        below[name] = draw(st.sampled_from(free))
    return {n: b for n, b in below.items() if draw(st.booleans())} if some else below


def carried_out(start: dict[str, str], moves) -> dict[str, str]:
    """Where moves lead; each of them must be possible."""
    below, held = dict(start), ""
    for move in moves:
        block = move.objects[0]
        if move.name == "pick":
            assert not held
            assert block not in below.values()
            held = block
            del below[block]
            continue
        assert held == block
        held = ""
        target = "table" if move.name == "place" else move.objects[1]
        assert target == "table" or (target in below and target not in below.values())
        below[block] = target
    assert not held
    return below


@given(towers(), towers(some=True))
def test_the_moves_are_possible_and_lead_to_the_goal(start, goal):
    end = carried_out(start, sequence(start, goal))
    assert {name: end[name] for name in goal} == goal
    assert set(end) == set(NAMES)


@given(towers(), towers(some=True))
def test_no_block_is_moved_more_than_twice(start, goal):
    picked = [move.objects[0] for move in sequence(start, goal) if move.name == "pick"]
    assert all(picked.count(name) <= 2 for name in picked)


@given(towers())
def test_nothing_is_done_where_all_stands_right(start):
    assert sequence(start, start) == ()


def test_what_is_in_the_way_goes_to_the_table_first():
    moves = [str(move) for move in sequence({"a": "table", "b": "a", "c": "table"}, {"a": "c"})]
    assert moves == ["pick(['b'], ...)", "place(['b'], ...)", "pick(['a'], ...)", "stack(['a', 'c'], ...)"]


def test_a_block_that_has_to_leave_its_place_leaves_it():
    moves = sequence({"a": "elsewhere", "b": "a"}, {"a": "table", "b": "a"})
    assert [move.objects[0] for move in moves] == ["b", "b", "a", "a", "b", "b"]
