from __future__ import annotations

from itertools import combinations
from math import dist

import pytest

from llm3.jsonio import dumps, loads
from llm3_blocks.domain import Blocks
from llm3_blocks.instance import BlocksInstance
from llm3_blocks.settings import APART, NAMES, SETTINGS, START_X, START_Y, TALLEST

SEEDS = range(40)


@pytest.fixture(scope="module", params=SETTINGS)
def drawn(request) -> list[BlocksInstance]:
    return [Blocks().instance(request.param, seed) for seed in SEEDS]


def test_there_are_three_to_six_blocks():
    assert SETTINGS == ("blocks-3", "blocks-4", "blocks-5", "blocks-6")
    for count, setting in enumerate(SETTINGS, start=3):
        assert [block.name for block in Blocks().instance(setting, 0).blocks] == list(NAMES[:count])


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
    assert 0 < sum(scattered) < len(scattered)


def test_goals_are_one_tower_or_two(drawn):
    counts = {[on.below for on in instance.goal].count("table") for instance in drawn}
    assert counts == ({1} if len(drawn[0].blocks) == 3 else {1, 2})


def test_the_regions_are_where_the_towers_start():
    instance = Blocks().instance("blocks-3", 0)
    regions = Blocks().regions(instance)
    assert regions[("place", ("red_block",), "x")] == START_X
    assert regions[("place", ("blue_block",), "y")] == START_Y
    assert len(regions) == 6
