"""Long blocks in close towers: what every problem of these settings promises, by its geometry alone."""

from __future__ import annotations

from itertools import combinations, pairwise
from math import dist

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.jsonio import dumps, loads
from llm3_blocks.colors import COLORS
from llm3_blocks.domain import Blocks
from llm3_blocks.instance import BlocksInstance
from llm3_blocks.rebuild import CENTER_X, HEIGHTS, LENGTH, PITCH, PLATE, POST, STEP, WIDTHS
from llm3_bullet.robots.panda import panda
from llm3_bullet.tabletop.grasps import OPENING_MARGIN, hand_heights, widest

some = settings(max_examples=25)
rebuilds = st.sampled_from([name for name in Blocks.settings if name.startswith("rebuild")])
seeds = st.integers(0, 10**6)
HAND = panda().fingers
ROOM = HAND.finger_reach + OPENING_MARGIN / 2
"""Beside a face that fingers grip, in metres."""


def drawn(setting: str, seed: int) -> BlocksInstance:
    return Blocks().instance(setting, seed)


def rows(instance: BlocksInstance) -> list[tuple[str, ...]]:
    """The blocks on each plate at the start, side by side."""
    return [tower.blocks[1:] for tower in instance.towers if tower.blocks[0].endswith("plate")]


@some
@given(rebuilds, seeds)
def test_the_same_seed_gives_the_same_problem_and_a_file_holds_it(setting, seed):
    instance = drawn(setting, seed)
    assert drawn(setting, seed) == instance
    assert loads(dumps(instance), BlocksInstance, "a file") == instance


@some
@given(rebuilds, seeds)
def test_each_block_starts_on_a_plate_and_belongs_elsewhere(setting, seed):
    instance = drawn(setting, seed)
    names = [f"{color}_block" for color in COLORS[: int(setting.removeprefix("rebuild-"))]]
    goal = {on.block: on.below for on in instance.goal}
    assert list(goal) == names == sorted({n for row in rows(instance) for n in row}, key=names.index)
    assert all(goal[name] != instance.start[name] for name in names)
    assert set(instance.to_move) == set(names)


@some
@given(rebuilds, seeds)
def test_towers_have_the_sizes_that_are_told(setting, seed):
    instance = drawn(setting, seed)
    sizes = instance.sizes
    for name in (on.block for on in instance.goal):
        length, width, height = sizes[name]
        assert length == LENGTH
        assert width in WIDTHS
        assert height in HEIGHTS
    assert {sizes[name] for name in sizes if name.endswith("plate")} == {PLATE}
    assert {sizes[name] for name in sizes if name.startswith("post")} == {POST}


@some
@given(rebuilds, seeds)
def test_a_tower_is_so_much_higher_than_its_neighbour_that_the_hand_has_no_room(setting, seed):
    instance = drawn(setting, seed)
    heights = [sum(instance.sizes[name][2] for name in row) for row in rows(instance)]
    assert max(abs(a - b) for a, b in pairwise(heights)) >= STEP > max(hand_heights(h, HAND)[1] - h for h in HEIGHTS)
    plates = [tower.position for tower in instance.towers if tower.blocks[0].endswith("plate")]
    assert all(dist(a, b) == pytest.approx(PITCH) for a, b in pairwise(plates))
    assert HAND.palm_size[0] / 2 > PITCH - min(WIDTHS) / 2


def test_fingers_have_room_between_equal_towers_but_no_block_lies_across_beside_a_higher_one():
    assert PITCH - max(WIDTHS) > ROOM
    assert LENGTH / 2 + min(WIDTHS) / 2 > PITCH
    assert max(WIDTHS) <= widest(HAND) < min(LENGTH, *PLATE[:2], *POST[:2])


@some
@given(rebuilds, seeds)
def test_where_the_witness_puts_a_block_the_hand_has_room_whatever_else_stands_there(setting, seed):
    instance, witness = drawn(setting, seed), Blocks().witness(setting, seed)
    spots = [(action.params["x"], action.params["y"]) for action in witness if action.name == "place"]
    posts = [tower.position for tower in instance.towers if tower.blocks[0].startswith("post")]
    towers = [tower.position for tower in instance.towers if tower.blocks[0].endswith("plate")]
    assert len(set(spots)) == len(instance.goal)
    along, across = (side / 2 for side in HAND.palm_size)
    for x, y in spots:
        for a, b in posts:
            half = POST[0] / 2
            assert abs(y - b) > along + half or abs(x - a) > max(across, LENGTH / 2) + half
        for a, b in towers:
            assert abs(y - b) > along + max(WIDTHS) / 2 or abs(x - a) > across + LENGTH / 2
    for (x, y), (a, b) in combinations(spots, 2):
        assert abs(y - b) > ROOM + max(WIDTHS) or abs(x - a) > LENGTH
    for (_, y), (_, b) in ((tower, post) for tower in towers for post in posts):
        assert abs(y - b) > along + POST[1] / 2
    assert hand_heights(max(HEIGHTS), HAND)[1] < POST[2]
    assert CENTER_X[0] <= towers[0][0] <= CENTER_X[1]
