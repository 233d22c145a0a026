from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from random_worlds import random_configurations

from llm3.types import Pose
from llm3_bullet.reach import extent, joints_below
from llm3_bullet.scene import HeldBox, Scene

ROBOTS = ("panda", "iiwa", "toy")
CARGO = HeldBox("cargo", (0.1, 0.03, 0.2), Pose((0.01, 0.0, 0.05)))


def all_points(checker, Q: np.ndarray, scene: Scene) -> np.ndarray:
    """World positions (N, V, 3) of every corner of the robot and of what it holds."""
    frames = checker.kinematics.link_frames(Q, scene.opening)
    points = [
        hull @ frames[:, link, :3, :3].swapaxes(1, 2) + frames[:, link, None, :3, 3]
        for link, hull in enumerate(checker.hulls)
        if len(hull)
    ]
    if scene.held:
        x, y, z = np.array(scene.held.size) / 2
        corners = np.array([[i, j, k] for i in (-x, x) for j in (-y, y) for k in (-z, z)])
        corners += scene.held.grasp.position
        tool = checker.kinematics.tool(Q)
        points.append(corners @ tool[:, :3, :3].swapaxes(1, 2) + tool[:, None, :3, 3])
    return np.concatenate(points, axis=1)


@settings(max_examples=30, deadline=None)
@given(
    seed=st.integers(0, 2**32 - 1),
    robot=st.sampled_from(ROBOTS),
    held=st.booleans(),
    clearance=st.floats(0.001, 0.02),
    alone=st.booleans(),
)
def test_between_neighbouring_samples_no_point_moves_farther_than_twice_the_clearance(
    checkers, seed, robot, held, clearance, alone
):
    checker, rng = checkers[robot], np.random.default_rng(seed)
    scene = Scene((), CARGO if held else None, 0.08)
    resolution = checker.view(scene).resolution(clearance)
    dof = len(resolution)
    shares = np.eye(dof)[rng.integers(dof, size=100)] if alone else rng.dirichlet(np.full(dof, 0.3), 100)
    Q = random_configurations(checker.kinematics, 100, rng)
    there = Q + shares * rng.choice([-1, 1], (100, dof)) * resolution
    moved = np.linalg.norm(all_points(checker, there, scene) - all_points(checker, Q, scene), axis=2)
    assert moved.max() <= 2 * clearance + 1e-12


def test_steps_are_not_needlessly_small(checker):
    """The base joint carries the whole arm, which reaches 1.07 m; the last one turns the hand, 11 cm to each side."""
    resolution = checker.view(Scene(opening=0.08)).resolution(0.005)
    assert 0.01 / resolution[0] < 1.25
    assert 0.01 / resolution[6] < 0.13


def test_a_held_box_makes_for_smaller_steps(checker):
    free, laden = (checker.view(Scene((), held, 0.08)).resolution(0.005) for held in (None, CARGO))
    assert (laden[:6] < free[:6]).all()
    assert laden[6] == free[6]  # the hand is wider than the box


@pytest.mark.parametrize("clearance", [0.0, -0.001, float("nan")])
def test_a_step_needs_a_clearance(checker, clearance):
    with pytest.raises(ValueError) as caught:
        checker.view(Scene()).resolution(clearance)
    assert str(caught.value) == f"a sampling step needs a positive clearance in metres, not {clearance}"


def test_a_link_moves_with_the_joints_below_it_and_no_other(checkers):
    for checker in checkers.values():
        model = checker.kinematics.model
        below = joints_below(model)
        base = checker.kinematics.link_frames(model.home[None], 0.0)[0]
        for joint in range(model.dof):
            q = model.home.copy()
            q[joint] += 0.1
            moved = np.abs(checker.kinematics.link_frames(q[None], 0.0)[0] - base).max(axis=(1, 2)) > 1e-9
            assert (moved == (below > joint)).all()


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), robot=st.sampled_from(ROBOTS), opening=st.floats(0.0, 1.0))
def test_no_link_is_farther_from_the_base_than_the_extent(checkers, seed, robot, opening):
    kinematics = checkers[robot].kinematics
    model = kinematics.model
    Q = random_configurations(kinematics, 50, np.random.default_rng(seed))
    frames = kinematics.link_frames(Q, opening * model.description.gripper.max_opening)
    assert np.linalg.norm(frames[..., :3, 3], axis=-1).max() <= extent(kinematics)
