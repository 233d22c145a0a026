"""Forward kinematics agrees with PyBullet, and the Jacobian with forward kinematics."""

from __future__ import annotations

import numpy as np
import pytest
from branching_arm import branching_arm
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3_bullet.clients import connect, quiet
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.mounting import urdf_file
from llm3_bullet.robots import iiwa, panda

ROBOTS = ("panda", "iiwa", "branching")
QUICK = settings(deadline=None, max_examples=40)
seeds = st.integers(0, 2**32 - 1)
robots = st.sampled_from(ROBOTS)
openings = st.floats(0.0, 0.06)


@pytest.fixture(scope="module")
def arms(tmp_path_factory):
    descriptions = {"panda": panda(), "iiwa": iiwa(), "branching": branching_arm(tmp_path_factory.mktemp("urdf"))}
    return {name: Kinematics(RobotModel(description)) for name, description in descriptions.items()}


@pytest.fixture(scope="module")
def in_pybullet(arms):
    """The link frames that PyBullet finds, (L, 4, 4), for a robot's name, a configuration and an opening."""
    with connect() as client:

        def load(model):
            with urdf_file(model.description) as file, quiet():
                return client.loadURDF(str(file), useFixedBase=True)

        bodies = {name: load(arm.model) for name, arm in arms.items()}

        def frames(name, q, opening):
            model, body = arms[name].model, bodies[name]
            for joint, position in zip(model.arm_joints, q, strict=True):
                client.resetJointState(body, joint, position)
            for joint in model.finger_joints:
                client.resetJointState(body, joint, opening / 2)
            found = np.tile(np.eye(4), (len(model.links), 1, 1))
            for link in range(1, len(model.links)):
                state = client.getLinkState(body, link - 1, computeForwardKinematics=True)
                found[link, :3, 3] = state[4]
                found[link, :3, :3] = np.reshape(client.getMatrixFromQuaternion(state[5]), (3, 3))
            return found

        yield frames


def configurations(arm, seed, count):
    return np.random.default_rng(seed).uniform(arm.model.low, arm.model.high, (count, arm.model.dof))


@given(robots, seeds, openings)
@QUICK
def test_link_frames_are_pybullets(arms, in_pybullet, name, seed, opening):
    (q,) = configurations(arms[name], seed, 1)
    (frames,) = arms[name].link_frames(q[None], opening)
    np.testing.assert_allclose(frames, in_pybullet(name, q, opening), atol=2e-6)  # PyBullet computes in part in float32


@given(robots, seeds, st.integers(0, 9), openings)
@QUICK
def test_a_batch_is_its_configurations_one_by_one(arms, name, seed, count, opening):
    arm, Q = arms[name], configurations(arms[name], seed, count)
    frames = arm.link_frames(Q, opening)
    assert frames.shape == (count, len(arm.model.links), 4, 4)
    for q, alone in zip(Q, frames, strict=True):
        np.testing.assert_allclose(alone, arm.link_frames(q[None], opening)[0], atol=1e-12)


@given(robots, seeds)
@QUICK
def test_the_tool_is_the_tool_links_frame_at_any_opening(arms, name, seed):
    arm, Q = arms[name], configurations(arms[name], seed, 3)
    for opening in (0.0, 0.05):
        np.testing.assert_allclose(arm.tool(Q), arm.link_frames(Q, opening)[:, arm.model.tool], atol=1e-12)


@given(robots, seeds, st.integers(1, 12), openings)
@QUICK
def test_points_are_placed_in_one_product(arms, name, seed, count, opening):
    arm, Q, rng = arms[name], configurations(arms[name], seed, count), np.random.default_rng(seed)
    links = rng.integers(0, len(arm.model.links), 6)
    points = rng.normal(size=(6, 3))
    placed = arm.joint_frames(Q).reshape(count, 4, -1) @ arm.placement(links, points, opening)
    frames = arm.link_frames(Q, opening)[:, links]
    expected = np.einsum("nsij,sj->nsi", frames[..., :3, :3], points) + frames[..., :3, 3]
    np.testing.assert_allclose(placed[:, :3].swapaxes(1, 2), expected, atol=1e-12)
    np.testing.assert_array_equal(placed[:, 3], 1.0)


@given(robots, seeds, openings)
@QUICK
def test_single_precision_is_right_to_a_micrometre(arms, name, seed, opening):
    arm, Q = arms[name], configurations(arms[name], seed, 3)
    single = Kinematics(arm.model, np.float32)
    frames = single.link_frames(Q, opening)
    assert frames.dtype == np.float32
    np.testing.assert_allclose(frames, arm.link_frames(Q, opening), atol=2e-6)


@given(robots, seeds)
@QUICK
def test_the_jacobian_is_the_derivative_of_the_tool_pose(arms, name, seed):
    arm, Q = arms[name], configurations(arms[name], seed, 2)
    jacobian, step = arm.jacobian(Q), 1e-6
    rotations = arm.tool(Q)[:, :3, :3]
    for joint in range(arm.model.dof):
        moved = np.eye(arm.model.dof)[joint] * step
        rate = (arm.tool(Q + moved) - arm.tool(Q - moved)) / (2 * step)
        spin = rate[:, :3, :3] @ rotations.swapaxes(1, 2)
        angular = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=1)
        np.testing.assert_allclose(jacobian[:, :3, joint], rate[:, :3, 3], atol=1e-7)
        np.testing.assert_allclose(jacobian[:, 3:, joint], angular, atol=1e-7)


@given(robots, seeds)
@QUICK
def test_tool_and_jacobian_come_together_as_they_do_alone(arms, name, seed):
    arm, Q = arms[name], configurations(arms[name], seed, 3)
    tool, jacobian = arm.tool_and_jacobian(Q)
    np.testing.assert_array_equal(tool, arm.tool(Q))
    np.testing.assert_array_equal(jacobian, arm.jacobian(Q))


@given(seeds, openings)
@QUICK
def test_frames_are_rigid(arms, seed, opening):
    frames = arms["panda"].link_frames(configurations(arms["panda"], seed, 2), opening)
    R = frames[..., :3, :3]
    np.testing.assert_allclose(R @ R.swapaxes(-1, -2), np.broadcast_to(np.eye(3), R.shape), atol=1e-9)
    np.testing.assert_array_equal(frames[..., 3, :], np.broadcast_to([0, 0, 0, 1], frames.shape[:-1]))
