"""The Franka Emika Panda with the Franka Hand, as pybullet_data ships it."""

from __future__ import annotations

from importlib.util import find_spec
from math import pi
from pathlib import Path

from llm3.errors import MissingDependency
from llm3.types import FrozenDict
from llm3_bullet.robot import ParallelGripper, RobotDescription

_JOINTS = tuple(f"panda_joint{i}" for i in range(1, 8))
_LOW = (-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973)
_HIGH = (2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973)


def panda() -> RobotDescription:
    """The Panda.

    Raises:
        MissingDependency: pybullet_data, which holds the URDF and the meshes, is not installed.
    """
    data = find_spec("pybullet_data")  # its folder is all that is needed, so it is not imported
    if data is None or data.origin is None:
        raise MissingDependency("the Panda's model comes with pybullet, which is not installed.")
    return RobotDescription(
        name="panda",
        urdf=Path(data.origin).parent / "franka_panda" / "panda.urdf",
        arm_joints=_JOINTS,
        tool_link="panda_grasptarget",
        home=(0.0, -pi / 4, 0.0, -3 * pi / 4, 0.0, pi / 2, pi / 4),
        gripper=ParallelGripper(
            joints=("panda_finger_joint1", "panda_finger_joint2"),
            links=("panda_hand", "panda_leftfinger", "panda_rightfinger"),
            max_opening=0.08,
            finger_reach=0.0264,
            closing_axis=(0.0, 1.0, 0.0),
            palm_height=0.039,
        ),
        joint_limits=FrozenDict(zip(_JOINTS, zip(_LOW, _HIGH, strict=True), strict=True)),
        may_touch=(("panda_link7", "panda_hand"),),
        mounted_links=("panda_link0",),
        source=(
            "Joint limits: Franka Control Interface documentation, limits for the Franka Emika Robot (Panda), "
            "https://frankarobotics.github.io/docs/robot_specifications.html; the shipped URDF's are wider. "
            "Home: where libfranka's examples start. Gripper: measured on the shipped collision meshes."
        ),
    )
