from __future__ import annotations

from itertools import combinations
from math import dist

import pytest

from llm3.jsonio import dumps, loads
from llm3_blocks.colors import COLORS
from llm3_blocks.cubes import APART, HIGHEST, MOST_TOWERS, START_X, START_Y, TALLEST
from llm3_blocks.domain import REACH_X, REACH_Y, Blocks
from llm3_blocks.instance import BlocksInstance

SEEDS = range(40)
CUBES = tuple(name for name in Blocks.settings if name.startswith("blocks"))


@pytest.fixture(scope="module", params=CUBES)
def drawn(request) -> list[BlocksInstance]:
    return [Blocks().instance(request.param, seed) for seed in SEEDS]


def test_there_are_as_many_blocks_as_the_name_says():
    assert CUBES == ("blocks-3", "blocks-4", "blocks-5", "blocks-6", "blocks-8", "blocks-10")
    for setting in CUBES:
        names = [f"{color}_block" for color in COLORS[: int(setting.removeprefix("blocks-"))]]
        assert [block.name for block in Blocks().instance(setting, 0).blocks] == names


def test_the_same_seed_gives_the_same_problem_and_another_one_another(drawn):
    for seed, instance in enumerate(drawn):
        assert Blocks().instance(f"blocks-{len(instance.blocks)}", seed) == instance
    assert len(set(map(dumps, drawn))) == len(drawn)


def test_a_file_holds_it_to_the_last_bit(drawn):
    for instance in drawn:
        assert loads(dumps(instance), BlocksInstance, "a file") == instance


def test_towers_start_apart_in_their_part_of_the_table(drawn):
    for instance in drawn:
        for tower in instance.towers:
            assert START_X[0] <= tower.position[0] <= START_X[1]
            assert START_Y[0] <= tower.position[1] <= START_Y[1]
            assert len(tower.blocks) <= TALLEST
        assert len(instance.towers) <= MOST_TOWERS
        for one, other in combinations(instance.towers, 2):
            assert dist(one.position, other.position) >= APART


def test_every_block_has_its_place_in_the_goal_and_something_is_to_be_done(drawn):
    for instance in drawn:
        goal = {on.block: on.below for on in instance.goal}
        assert set(goal) == {block.name for block in instance.blocks}
        assert goal != instance.start
        assert Blocks().skeleton(instance)


def test_some_seeds_scatter_the_blocks_and_some_pile_them_up(drawn):
    scattered = [set(instance.start.values()) == {"table"} for instance in drawn]
    assert sum(scattered) < len(scattered)
    assert (sum(scattered) > 0) == (len(drawn[0].blocks) <= MOST_TOWERS)


def test_goals_are_one_tower_or_two(drawn):
    counts = {[on.below for on in instance.goal].count("table") for instance in drawn}
    blocks = len(drawn[0].blocks)
    assert counts == ({1} if blocks == 3 else {1, 2} if blocks <= HIGHEST else {2})
    assert all(max(instance.heights.values()) < HIGHEST * 0.05 for instance in drawn)


def test_the_regions_are_where_the_towers_start():
    instance = Blocks().instance("blocks-3", 0)
    regions = Blocks().regions(instance)
    assert regions[("place", ("red_block",), "x")] == START_X
    assert regions[("place", ("blue_block",), "y")] == START_Y
    assert len(regions) == 6


def test_more_blocks_are_put_aside_on_more_of_the_table():
    regions = Blocks().regions(Blocks().instance("blocks-8", 0))
    assert regions[("place", ("red_block",), "x")] == REACH_X
    assert regions[("place", ("red_block",), "y")] == REACH_Y
