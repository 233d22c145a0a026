"""What is said of the samples of a straight line that need no test: they are valid, whatever the line and the scene."""

from __future__ import annotations

import numpy as np
import pytest
from random_worlds import random_configurations, random_scene

from llm3_bullet.collision import LIMIT_TOLERANCE, CollisionChecker

ROBOTS = ("panda", "iiwa", "toy")
CLEARANCES = (0.0, 0.005, -0.0005)
"""In metres."""


def certain_samples(checker: CollisionChecker, seed: int, held: bool, finer: float) -> np.ndarray:
    """For each sample that is certain, on lines between random configurations of a random scene, if it is valid."""
    rng = np.random.default_rng(seed)
    view = checker.view(random_scene(checker.kinematics, rng, held))
    clearance = float(rng.choice(CLEARANCES))
    verdicts = [np.empty(0, dtype=bool)]
    for start, end in random_configurations(checker.kinematics, 8, rng).reshape(4, 2, -1):
        steps = int(np.ceil((np.abs(end - start) / view.resolution(0.005)).sum() * finer))
        numbers = np.flatnonzero(~view.uncertain(start, end, steps, clearance))
        samples = start + (end - start) * numbers[:, None] / steps
        verdicts.append(view.valid(samples, clearance, coarse=False))
    return np.concatenate(verdicts)


@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("robot", ROBOTS)
def test_a_sample_that_needs_no_test_is_valid_for_pybullet_alone(checkers, robot, held):
    verdicts = [certain_samples(checkers[robot], seed, held, finer=0.5) for seed in range(12)]
    assert np.concatenate(verdicts).all()
    assert sum(map(len, verdicts)) > 300  # or it would say little


@pytest.mark.slow
@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("robot", ROBOTS)
def test_a_sample_that_needs_no_test_is_valid_for_pybullet_alone_in_many_worlds(checkers, robot, held):
    for seed in range(1000, 1100):
        assert certain_samples(checkers[robot], seed, held, finer=(seed % 5 + 1) / 4).all(), f"seed {seed}"


def test_every_sample_needs_a_test_where_an_end_is_outside_of_the_joint_limits(checker):
    model = checker.kinematics.model
    view = checker.view(random_scene(checker.kinematics, np.random.default_rng(0), held=False))
    assert view.uncertain(model.home, model.high + 0.1, 20, 0.005).tolist() == [True] * 21


def test_looks_for_room_are_counted_as_tests(checker):
    model = checker.kinematics.model
    view = checker.view(random_scene(checker.kinematics, np.random.default_rng(0), held=False))
    view.uncertain(model.home, model.low, 24, 0.005)
    assert view.checks == 3


def test_what_rounding_takes_beyond_a_limit_needs_a_test(checkers):
    """Both ends are just within the tolerance of the limits, and some samples between them are not."""
    checker = checkers["iiwa"]
    view = checker.view(random_scene(checker.kinematics, np.random.default_rng(0), held=False))
    model = checker.kinematics.model
    for joint, limits in enumerate(zip(model.low - LIMIT_TOLERANCE, model.high + LIMIT_TOLERANCE, strict=True)):
        for limit in limits:
            start, end = model.home.copy(), model.home + 0.3
            start[joint] = end[joint] = limit
            end = np.clip(end, model.low - LIMIT_TOLERANCE, model.high + LIMIT_TOLERANCE)
            for steps in (17, 43, 100):
                numbers = np.flatnonzero(~view.uncertain(start, end, steps, 0.005))
                samples = (start * (steps - numbers[:, None]) + end * numbers[:, None]) / steps
                assert view.valid(samples, 0.005).all()
