"""Robots that ship with the library are what their descriptions say."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

from llm3.errors import MissingDependency
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.robot_files import locate
from llm3_bullet.robots import panda
from llm3_bullet.urdf import read_urdf

PANDA = locate(panda().urdf)


@pytest.fixture(scope="module")
def model():
    return RobotModel(panda())


def mesh_vertices(name):
    lines = (PANDA.parent / "meshes" / "collision" / name).read_text().splitlines()
    return np.array([line.split()[1:4] for line in lines if line.startswith("v ")], dtype=float)


def test_the_pandas_limits_are_those_that_its_maker_publishes(model):
    assert model.low.tolist() == [-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973]
    assert model.high.tolist() == [2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973]


def test_the_pandas_limits_are_tighter_than_those_of_the_urdf(model):
    limits = {joint.name: joint.limits for joint in read_urdf(PANDA).joints}
    for name, low, high in zip(panda().arm_joints, model.low, model.high, strict=True):
        assert limits[name][0] < low < high < limits[name][1]


def test_at_home_the_pandas_hand_points_down_in_front_of_it(model):
    tool = Kinematics(model).tool(model.home[None])[0]
    np.testing.assert_allclose(tool[:3, 2], [0, 0, -1], atol=1e-9)
    assert tool[0, 3] > 0.3
    assert abs(tool[1, 3]) < 1e-9
    assert tool[2, 3] > 0.3


def test_the_pandas_fingers_open_along_the_closing_axis_by_half_each(model):
    frames = Kinematics(model).link_frames(model.home[None], 0.06)[0]
    to_tool = np.linalg.inv(frames[model.tool])
    left, right = ((to_tool @ frames[model.link(f"panda_{side}finger")])[:3, 3] for side in ("left", "right"))
    np.testing.assert_allclose(left - right, 0.06 * np.array(panda().gripper.closing_axis), atol=1e-12)
    np.testing.assert_allclose(left + right, [0, 0, (left + right)[2]], atol=1e-12)


def test_the_pandas_hand_is_as_large_as_its_meshes(model):
    frames = Kinematics(model).link_frames(model.home[None], 0.0)[0]
    from_tool_to_hand = (np.linalg.inv(frames[model.link("panda_hand")]) @ frames[model.tool])[2, 3]
    palm = mesh_vertices("hand.obj")[:, 2].max()
    assert panda().gripper.palm_height == pytest.approx(from_tool_to_hand - palm, abs=1e-4)
    finger, hand = mesh_vertices("finger.obj"), mesh_vertices("hand.obj")
    assert panda().gripper.finger_reach == pytest.approx(finger[:, 1].max(), abs=1e-4)
    assert panda().gripper.finger_width == pytest.approx(np.ptp(finger[:, 0]), abs=1e-4)
    from_tool_to_finger = (np.linalg.inv(frames[model.link("panda_leftfinger")]) @ frames[model.tool])[2, 3]
    assert panda().gripper.tip_depth == pytest.approx(finger[:, 2].max() - from_tool_to_finger, abs=5e-4)
    along, across = 2 * np.abs(hand[:, [1, 0]]).max(axis=0)
    assert panda().gripper.palm_size == pytest.approx((along, across), abs=1e-3)
    high = [read_urdf(PANDA).joints[number].limits[1] for number in model.finger_joints]
    assert panda().gripper.max_opening == pytest.approx(sum(high))


def test_describing_the_panda_loads_no_simulator():
    code = (
        "import sys; from llm3_bullet.robots import panda; from llm3_bullet.model import RobotModel; "
        "RobotModel(panda()); print([m for m in sys.modules if m.startswith('pybullet')])"
    )
    done = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path[:] = {sys.path!r}; {code}"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.strip() == "[]"


def test_without_pybullet_the_panda_says_what_is_missing(monkeypatch):
    monkeypatch.setitem(sys.modules, "pybullet_data", None)
    with pytest.raises(MissingDependency) as caught:
        RobotModel(panda())
    assert str(caught.value) == (
        "the robot file package://pybullet_data/franka_panda/panda.urdf needs the Python package pybullet_data, "
        "which is not installed."
    )
