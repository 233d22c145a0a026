from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from random_worlds import random_configurations

from llm3_bullet.self_collision import NeighbourClearance, link_pairs

ROBOTS = ("panda", "iiwa", "toy")


def solid(checker) -> list[int]:
    return [link for link, hull in enumerate(checker.hulls) if len(hull)]


def test_the_pairs_of_the_toy_arm_are_these(checkers):
    model = checkers["toy"].kinematics.model
    names = {(model.links[a], model.links[b]) for a, b in link_pairs(model, solid(checkers["toy"]))}
    arm = {"rail", "trunk", "upper", "lower"}
    everything = {tuple(pair) for pair in combinations(("rail", "trunk", "upper", "lower", "hand", "left", "right"), 2)}
    joined = {("rail", "trunk"), ("trunk", "upper"), ("upper", "lower")}
    rigid = {("lower", "hand")}
    gripper = {pair for pair in everything if not set(pair) & arm}
    allowed = {("trunk", "lower")}
    assert names == everything - joined - rigid - gripper - allowed


@pytest.mark.parametrize("robot", ROBOTS)
def test_the_bounds_never_exceed_the_distance(checkers, robot):
    checker = checkers[robot]
    model = checker.kinematics.model
    pairs = link_pairs(model, solid(checker))
    bounds = NeighbourClearance(checker.kinematics, checker.hulls, pairs, checker.narrowphase.link_distance, cells=16)
    assert bounds.pairs
    Q = random_configurations(checker.kinematics, 300, np.random.default_rng(0))
    Q = np.concatenate([Q, model.low[None], model.high[None]])
    for q, row in zip(Q, bounds.bounds(Q), strict=True):
        for pair, bound in zip(bounds.pairs, row, strict=True):
            assert bounds.least[pair] <= bound <= checker.narrowphase.link_distance(q, pair) + 1e-4


def test_finer_cells_tell_more(checker):
    model = checker.kinematics.model
    pairs = [(model.link("panda_link5"), model.link("panda_hand"))]
    Q = random_configurations(checker.kinematics, 2000, np.random.default_rng(0))

    def cleared(cells: int) -> float:
        distance = checker.narrowphase.link_distance
        tables = NeighbourClearance(checker.kinematics, checker.hulls, pairs, distance, cells=cells)
        return float(np.mean(tables.bounds(Q) > 0.005))

    assert cleared(4) < cleared(16) < cleared(64)
