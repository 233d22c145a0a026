"""An arm is called too short only for poses that it cannot have, and hardly any other is left to a search."""

from __future__ import annotations

import numpy as np
import pytest
from branching_arm import JOINTS, branching_arm, urdf
from hypothesis import given, settings
from hypothesis import strategies as st
from tool_poses import beyond_the_panda, random_top_down, top_down
from toy_arm import toy_arm

from llm3_bullet.arm_length import ArmLength
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.robots import iiwa, panda

ROBOTS = ("panda", "iiwa", "branching", "toy")
seeds = st.integers(0, 2**32 - 1)


@pytest.fixture(scope="module")
def arms(tmp_path_factory):
    folder = tmp_path_factory.mktemp("urdf")
    descriptions = {"panda": panda(), "iiwa": iiwa(), "branching": branching_arm(folder), "toy": toy_arm(folder)}
    return {name: Kinematics(RobotModel(description)) for name, description in descriptions.items()}


@pytest.fixture(scope="module")
def lengths(arms):
    return {name: ArmLength(arm) for name, arm in arms.items()}


def stretched(arm, rng, count):
    """Configurations of which many joints are at a limit or near zero, where an arm reaches furthest."""
    uniform = rng.uniform(arm.model.low, arm.model.high, (count, arm.model.dof))
    low, high = arm.model.low, arm.model.high
    choice = rng.integers(4, size=uniform.shape)
    return np.clip(np.choose(choice, [uniform, 0.05 * uniform, low, high]), low, high)


@given(st.sampled_from(ROBOTS), seeds)
@settings(max_examples=60)
def test_no_pose_of_a_configuration_is_too_far(arms, lengths, name, seed):
    poses = arms[name].tool(stretched(arms[name], np.random.default_rng(seed), 200))
    assert not lengths[name].too_short(poses, 1e-9, 0.0).any()


@given(st.sampled_from(ROBOTS), seeds, st.floats(-1.0, 3.0))
def test_beyond_the_disc_no_height_is_within_reach_from_above(lengths, name, seed, height):
    disc = lengths[name].disc
    azimuth, yaw = np.random.default_rng(seed).uniform(-np.pi, np.pi, (2, 50))
    beyond = disc.radius + 1e-9
    x, y = disc.center[0] + beyond * np.cos(azimuth), disc.center[1] + beyond * np.sin(azimuth)
    assert lengths[name].too_short(top_down(x, y, height, yaw), 0.0, 0.0).all()


@given(st.sampled_from(ROBOTS), seeds, st.floats(0.0, 1e-3), st.floats(0.0, 1e-3))
def test_nor_is_a_pose_within_the_tolerances_of_one(arms, lengths, name, seed, metres, radians):
    rng = np.random.default_rng(seed)
    poses = arms[name].tool(stretched(arms[name], rng, 50))
    away, turn = (axis / np.linalg.norm(axis) for axis in rng.normal(size=(2, 3)))
    cross = np.cross(np.eye(3), turn)
    moved = poses.copy()
    moved[:, :3, 3] += metres * away
    moved[:, :3, :3] = (np.eye(3) + np.sin(radians) * cross + (1 - np.cos(radians)) * cross @ cross) @ poses[:, :3, :3]
    assert not lengths[name].too_short(moved, metres + 1e-9, radians).any()


def test_the_bound_is_tight_for_the_panda_top_down(lengths):
    poses = random_top_down(np.random.default_rng(0), 4000, radius=(0.6, 1.0))
    beyond = beyond_the_panda(poses)
    too_short = lengths["panda"].too_short(poses, 1e-5, 1e-4)
    assert not too_short[beyond <= 0].any()
    assert too_short[beyond > 0.01].all()


def test_a_pose_far_away_is_too_far_for_every_arm(arms, lengths):
    for name, length in lengths.items():
        poses = arms[name].tool(arms[name].model.home[None])
        poses[:, :3, 3] += 10.0
        assert length.too_short(poses, 1e-5, 1e-4).all()


def test_an_arm_of_one_joint_is_too_short_for_all_that_is_not_on_its_circle(tmp_path):
    joint = JOINTS.replace('name="j2" type="prismatic"', 'name="j2" type="fixed"')
    joint = joint.replace('name="j3" type="continuous"', 'name="j3" type="fixed"')
    one = Kinematics(RobotModel(branching_arm(tmp_path, urdf(joint), arm_joints=("j1",), home=(0.0,), joint_limits={})))
    length, turns = ArmLength(one), one.tool(np.linspace(one.model.low, one.model.high, 50))
    assert not length.too_short(turns, 1e-5, 1e-4).any()
    turns[:, :3, 3] += 0.01
    assert length.too_short(turns, 1e-5, 1e-4).all()
