from __future__ import annotations

import numpy as np
import pytest
from random_worlds import random_configurations, random_scene

from llm3.types import Pose
from llm3_bullet.collision import CollisionChecker
from llm3_bullet.scene import Box, Scene
from llm3_bullet.thick_world import LARGEST_CLEARANCE

ROBOTS = ("panda", "iiwa", "toy")


def cleared(checker: CollisionChecker, scene: Scene, Q: np.ndarray) -> np.ndarray:
    checker.thick_world.show(scene)
    return np.array([checker.thick_world.is_clear(q) for q in Q.tolist()])


def wrongly_cleared(checker: CollisionChecker, rng: np.random.Generator, held: bool, count: int) -> int:
    """How many configurations in a random scene are cleared that PyBullet's queries call too close."""
    scene = random_scene(checker.kinematics, rng, held)
    Q = random_configurations(checker.kinematics, count, rng)
    Q = Q[cleared(checker, scene, Q)]
    return int((~checker.view(scene).valid(Q, LARGEST_CLEARANCE, coarse=False)).sum()) if len(Q) else 0


@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("robot", ROBOTS)
def test_nothing_is_cleared_that_comes_closer_than_the_largest_clearance(checkers, robot, held):
    for seed in range(20):
        assert wrongly_cleared(checkers[robot], np.random.default_rng(seed), held, 60) == 0, f"seed {seed}"


@pytest.mark.slow
@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("robot", ROBOTS)
def test_nothing_is_cleared_wrongly_in_many_worlds(checkers, robot, held):
    for seed in range(3000, 3200):
        assert wrongly_cleared(checkers[robot], np.random.default_rng(seed), held, 250) == 0, f"seed {seed}"


def test_most_of_what_keeps_the_largest_clearance_is_cleared(checker):
    rng = np.random.default_rng(0)
    scene = random_scene(checker.kinematics, rng, held=True)
    Q = random_configurations(checker.kinematics, 400, rng)
    Q = Q[checker.view(scene).valid(Q, LARGEST_CLEARANCE)]
    assert cleared(checker, scene, Q).mean() > 0.9


@pytest.mark.parametrize("gap", [0.0005, 0.002, 0.0045])
@pytest.mark.parametrize("way", [(1, 0, 0), (0, 1, 0), (0, 0, -1)])
def test_a_box_that_is_closer_than_the_largest_clearance_is_noticed(checker, gap, way):
    """The box is loaded where the robot is, and does not move before the question."""
    home = checker.kinematics.model.home
    tool = checker.kinematics.tool(home[None])[0, :3, 3]
    for distance in np.arange(0.0, 0.2, 0.001):
        scene = Scene((Box("box", (0.04, 0.04, 0.04), Pose(tuple(tool + distance * np.array(way)))),), None, 0.08)
        if checker.view(scene).valid(home[None], gap, coarse=False)[0]:
            break
        assert not cleared(checker, scene, home[None])[0]
    else:
        pytest.fail("the box never got out of the way")


def test_the_base_stands_on_what_is_fixed_and_on_nothing_else(checker):
    home = checker.kinematics.model.home
    ground = [Box("ground", (1.0, 1.0, 0.1), Pose((0.0, 0.0, -0.05)), fixed) for fixed in (True, False, True)]
    answers = [cleared(checker, Scene((box,), None, 0.08), home[None])[0] for box in ground]
    assert answers == [True, False, True]


def test_a_box_around_the_world_s_origin_is_noticed_at_once(checker):
    home = checker.kinematics.model.home
    box = Box("stone", (0.123, 0.123, 0.123), Pose((0.0, 0.0, 0.0)))
    assert not cleared(checker, Scene((box,), None, 0.08), home[None])[0]
