"""Straight pieces are straight, also between their waypoints, and refused where the arm cannot follow them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tool_poses import random_top_down, top_down

from llm3_bullet.descent import magnitudes, pose_error
from llm3_bullet.inverse import InverseKinematics
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.robots import panda
from llm3_bullet.straight import MAX_JUMP, line_poses, straight_line

QUICK = settings(deadline=None, max_examples=40)
seeds = st.integers(0, 2**32 - 1)


@pytest.fixture(scope="module")
def arm():
    return Kinematics(RobotModel(panda()))


@pytest.fixture(scope="module")
def inverse(arm):
    return InverseKinematics(arm)


def lift(arm, inverse, low, height=0.1):
    """Lines straight up from all solutions for a pose: start configurations, poses, waypoints and verdicts."""
    starts = inverse.solve(low, np.random.default_rng(0)).solutions
    high = low.copy()
    high[2, 3] += height
    targets = line_poses(low, high, 0.01)
    return starts, targets, *straight_line(arm, starts, targets)


@given(seeds)
@QUICK
def test_waypoints_meet_the_poses_within_limits_and_without_jumps(arm, inverse, seed):
    (low,) = random_top_down(np.random.default_rng(seed), 1)
    starts, targets, waypoints, followed = lift(arm, inverse, low)
    assert waypoints.shape == (len(starts), len(targets), 7)
    for start, line in zip(starts[followed], waypoints[followed], strict=True):
        assert arm.model.within_limits(line).all()
        assert (magnitudes(pose_error(arm.tool(line), targets)) <= (1.1e-5, 1.1e-4)).all()
        assert np.abs(np.diff([start, *line], axis=0)).max() <= MAX_JUMP


@given(seeds)
@QUICK
def test_between_waypoints_the_tool_stays_within_half_a_millimetre_of_the_line(arm, inverse, seed):
    (low,) = random_top_down(np.random.default_rng(seed), 1)
    starts, _, waypoints, followed = lift(arm, inverse, low)
    whole = np.concatenate([starts[:, None], waypoints], axis=1)[followed]
    for fraction in np.linspace(0.0, 1.0, 11):
        between = (1 - fraction) * whole[:, :-1] + fraction * whole[:, 1:]
        tool = arm.tool(between.reshape(-1, 7))
        assert np.linalg.norm(tool[:, :2, 3] - low[:2, 3], axis=1).max(initial=0.0) <= 5.1e-4


def test_nearly_every_lift_in_the_workspace_can_be_followed_from_some_solution(arm, inverse):
    poses = random_top_down(np.random.default_rng(0), 60, radius=(0.35, 0.75))
    assert sum(lift(arm, inverse, low)[3].any() for low in poses) >= 59


def test_lines_are_independent_of_each_other(arm, inverse):
    starts, targets, waypoints, followed = lift(arm, inverse, top_down(0.5, 0.1, 0.05, 0.4))
    assert followed.any()
    for start, line, verdict in zip(starts, waypoints, followed, strict=True):
        alone, alone_followed = straight_line(arm, start[None], targets)
        assert alone_followed[0] == verdict
        if verdict:
            np.testing.assert_allclose(alone[0], line, atol=1e-6)


def test_a_line_out_of_reach_is_refused(arm, inverse):
    *_, followed = lift(arm, inverse, top_down(0.78, 0.0, 0.1, 0.0), height=0.4)
    assert len(followed) > 0
    assert not followed.any()


def test_a_line_from_somewhere_else_is_refused_as_a_jump(arm, inverse):
    here, there = (inverse.solve(top_down(0.5, y, 0.1, 0.0), np.random.default_rng(0)).solutions for y in (-0.3, 0.3))
    targets = line_poses(*arm.tool(np.array([there[0], there[0]])), 0.01)
    _, followed = straight_line(arm, here, targets)
    assert not followed.any()


def test_a_line_with_too_few_poses_strays_and_is_refused(arm, inverse):
    low, high = top_down(0.5, -0.3, 0.1, 0.0), top_down(0.5, 0.3, 0.1, 0.0)
    starts = inverse.solve(low, np.random.default_rng(0)).solutions
    assert not straight_line(arm, starts, high[None])[1].any()


def test_no_start_is_no_line(arm):
    waypoints, followed = straight_line(arm, np.empty((0, 7)), top_down(0.5, 0.0, np.array([0.1, 0.11]), 0.0))
    assert waypoints.shape == (0, 2, 7)
    assert followed.shape == (0,)


@given(st.floats(0.0, 0.4), st.floats(0.001, 0.1))
@QUICK
def test_line_poses_are_even_and_end_at_the_end(length, spacing):
    start, end = top_down(0.4, 0.0, 0.1, 0.2), top_down(0.4, length, 0.1, 0.2)
    poses = line_poses(start, end, spacing)
    steps = np.linalg.norm(np.diff([start[:3, 3], *poses[:, :3, 3]], axis=0), axis=1)
    np.testing.assert_array_equal(poses[-1], end)
    np.testing.assert_allclose(steps, length / len(poses), atol=1e-9)
    assert (steps <= spacing * (1 + 1e-6)).all()
    assert len(poses) == 1 or length / (len(poses) - 1) > spacing * (1 - 1e-6)
    np.testing.assert_array_equal(poses[:, :3, :3], np.broadcast_to(end[:3, :3], (len(poses), 3, 3)))
