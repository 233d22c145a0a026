"""Inverse kinematics finds what forward kinematics made, keeps its promises, and says how far it fell short."""

from __future__ import annotations

import numpy as np
import pytest
from branching_arm import branching_arm
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation
from tool_poses import beyond_the_panda, random_top_down, top_down

from llm3_bullet.descent import POSITION_TOLERANCE, ROTATION_TOLERANCE, magnitudes, pose_error
from llm3_bullet.inverse import InverseKinematics
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.robots import panda

QUICK = settings(deadline=None, max_examples=40)
seeds = st.integers(0, 2**32 - 1)
CLEARLY_WITHIN = -0.01  # metres


@pytest.fixture(scope="module")
def arm():
    return Kinematics(RobotModel(panda()))


@pytest.fixture(scope="module")
def inverse(arm):
    return InverseKinematics(arm)


def rng():
    return np.random.default_rng(0)


def configurations(arm, seed, count):
    return np.random.default_rng(seed).uniform(arm.model.low, arm.model.high, (count, arm.model.dof))


def assert_promises(arm, target, result):
    """Whatever the target, the result is what its docstring says."""
    solutions, closest = result.solutions, result.closest[None]
    assert arm.model.within_limits(np.vstack([solutions, closest])).all()
    errors = magnitudes(pose_error(arm.tool(solutions), np.broadcast_to(target, (len(solutions), 4, 4))))
    assert (errors <= (POSITION_TOLERANCE * 1.001, ROTATION_TOLERANCE * 1.001)).all()
    apart = np.linalg.norm(solutions[:, None] - solutions[None], axis=2)[np.triu_indices(len(solutions), 1)]
    assert (apart >= 0.1).all()
    (shortfall,) = magnitudes(pose_error(arm.tool(closest), target[None]))
    np.testing.assert_allclose((result.position_error, result.rotation_error), shortfall, atol=1e-9)
    assert result.reached == (len(solutions) > 0)
    assert result.reached == (
        result.position_error <= POSITION_TOLERANCE and result.rotation_error <= ROTATION_TOLERANCE
    )


@given(seeds)
@QUICK
def test_a_pose_that_a_configuration_has_is_reached(arm, inverse, seed):
    (target,) = arm.tool(configurations(arm, seed, 1))
    result = inverse.solve(target, rng())
    assert result.reached
    assert_promises(arm, target, result)


@given(st.floats(0.0, 1.3), st.floats(-np.pi, np.pi), st.floats(-0.2, 1.2), st.floats(-np.pi, np.pi))
@QUICK
def test_promises_are_kept_wherever_the_target_is(arm, inverse, radius, azimuth, height, yaw):
    target = top_down(radius * np.cos(azimuth), radius * np.sin(azimuth), height, yaw)
    assert_promises(arm, target, inverse.solve(target, rng()))


@given(seeds)
@QUICK
def test_top_down_the_panda_reaches_exactly_what_its_arm_is_long_enough_for(inverse, seed):
    targets = random_top_down(np.random.default_rng(seed), 4, radius=(0.35, 1.0))
    for beyond, result in zip(beyond_the_panda(targets), inverse.solve_many(targets, rng()), strict=True):
        if beyond < CLEARLY_WITHIN or beyond > 1e-4:  # in between it depends on the wrist's limits
            assert result.reached == (beyond < 0)


def test_no_pose_of_a_configuration_and_no_top_down_pose_in_reach_is_missed(arm, inverse):
    top = random_top_down(np.random.default_rng(1), 400)
    targets = np.concatenate([arm.tool(configurations(arm, 2, 400)), top[beyond_the_panda(top) < CLEARLY_WITHIN]])
    assert all(result.reached for result in inverse.solve_many(targets, rng()))


@pytest.mark.slow
def test_among_thousands_none_is_missed(arm, inverse):
    top = random_top_down(np.random.default_rng(3), 4000)
    targets = np.concatenate([arm.tool(configurations(arm, 4, 4000)), top[beyond_the_panda(top) < CLEARLY_WITHIN]])
    missed = [target for target in targets if not inverse.solve(target, rng()).reached]
    assert missed == []


@given(st.floats(-np.pi, np.pi), st.floats(-np.pi, np.pi), st.floats(1.0, 1.5))
@QUICK
def test_the_shortfall_is_at_least_what_the_arm_is_too_short_and_hardly_more(inverse, azimuth, yaw, radius):
    target = top_down(radius * np.cos(azimuth), radius * np.sin(azimuth), 0.1, yaw)
    result = inverse.solve(target, rng())
    assert not result.reached
    (beyond,) = beyond_the_panda(target[None])  # what a hand that stays upright lacks; one that tilts lacks less
    assert result.position_error <= beyond + 0.02
    assert np.hypot(result.position_error, result.rotation_error) <= beyond + 0.02
    assert np.hypot(result.position_error, result.rotation_error) >= 0.8 * beyond


def test_a_target_that_the_arm_is_long_enough_for_is_given_up_only_after_many_more_starts(inverse):
    met, folded = (inverse.solve(top_down(x, 0.0, 0.0, 0.0), rng()) for x in (0.5, 0.0))
    assert met.reached
    assert not folded.reached
    assert folded.starts > 10 * met.starts
    assert np.hypot(folded.position_error, folded.rotation_error) > 0.01


@given(seeds, seeds)
@QUICK
def test_solutions_come_by_their_distance_to_the_given_configuration(arm, inverse, seed, other):
    (target,) = arm.tool(configurations(arm, seed, 1))
    (near,) = configurations(arm, other, 1)
    result = inverse.solve(target, rng(), near=near)
    distances = np.linalg.norm(result.solutions - near, axis=1)
    assert (np.diff(distances) >= 0).all()
    assert_promises(arm, target, result)


@given(seeds)
@QUICK
def test_a_solution_that_is_given_comes_first(arm, inverse, seed):
    (q,) = configurations(arm, seed, 1)
    result = inverse.solve(arm.tool(q[None])[0], rng(), near=q)
    np.testing.assert_array_equal(result.solutions[0], q)


@given(seeds)
@QUICK
def test_the_same_question_has_the_same_answer(arm, inverse, seed):
    target = random_top_down(np.random.default_rng(seed), 1, radius=(0.3, 1.0))[0]
    again = InverseKinematics(arm) if seed % 10 == 0 else inverse
    first, second = inverse.solve(target, rng()), again.solve(target, rng())
    np.testing.assert_array_equal(first.solutions, second.solutions)
    np.testing.assert_array_equal(first.closest, second.closest)


@given(seeds, st.integers(0, 5))
@QUICK
def test_several_targets_are_solved_like_one_by_one(inverse, seed, count):
    targets = random_top_down(np.random.default_rng(seed), count)
    targets = targets[beyond_the_panda(targets) < CLEARLY_WITHIN]
    together = inverse.solve_many(targets, rng())
    assert len(together) == len(targets)
    for target, result in zip(targets, together, strict=True):
        alone = inverse.solve(target, rng())
        assert result.starts == alone.starts
        np.testing.assert_allclose(result.solutions, alone.solutions, atol=1e-6)


def test_a_nearly_reachable_target_in_the_panda_is_met_in_several_ways(inverse):
    assert len(inverse.solve(top_down(0.5, 0.1, 0.1, 0.3), rng()).solutions) >= 4


@given(seeds)
@QUICK
def test_an_arm_with_fewer_joints_and_a_slide_is_solved_too(few_joints, seed):
    arm, inverse = few_joints
    (target,) = arm.tool(configurations(arm, seed, 1))
    result = inverse.solve(target, rng())
    assert result.reached
    assert_promises(arm, target, result)


@pytest.fixture(scope="module")
def few_joints(tmp_path_factory):
    arm = Kinematics(RobotModel(branching_arm(tmp_path_factory.mktemp("urdf"))))
    return arm, InverseKinematics(arm)


@given(seeds, st.floats(0.0, np.pi))
@QUICK
def test_the_rotation_error_is_the_rotation_vector(seed, angle):
    generator = np.random.default_rng(seed)
    axis = generator.normal(size=3)
    axis /= np.linalg.norm(axis)
    pose, target = np.eye(4), np.eye(4)
    pose[:3, :3] = Rotation.random(random_state=seed).as_matrix()
    target[:3, :3] = Rotation.from_rotvec(angle * axis).as_matrix() @ pose[:3, :3]
    target[:3, 3] = generator.normal(size=3)
    (error,) = pose_error(pose[None], target[None])
    np.testing.assert_allclose(error[:3], target[:3, 3])
    assert np.linalg.norm(error[3:]) == pytest.approx(angle, abs=1e-7)
    if angle < np.pi - 1e-6:
        np.testing.assert_allclose(error[3:], angle * axis, atol=1e-6)


def test_the_panda_reaches_what_it_is_said_to_reach_from_above(inverse):
    draw = rng()
    low, high = panda().reach_from_above
    azimuth, yaw = draw.uniform(-np.pi / 2, np.pi / 2, 300), draw.uniform(-np.pi, np.pi, 300)
    radius = draw.choice([low, (low + high) / 2, high], 300)
    poses = top_down(radius * np.cos(azimuth), radius * np.sin(azimuth), draw.uniform(0.01, 0.1, 300), yaw)
    assert all(result.reached for result in inverse.solve_many(poses, draw))
