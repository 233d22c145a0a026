"""The Franka Emika Panda with the Franka Hand, as pybullet_data ships it."""

from __future__ import annotations

from math import pi

from llm3_bullet.robot import ParallelGripper, RobotDescription

_JOINTS = tuple(f"panda_joint{i}" for i in range(1, 8))
_LOW = (-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973)
_HIGH = (2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973)
_ACCELERATION = (15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0)


def panda() -> RobotDescription:
    """The Panda."""
    return RobotDescription(
        name="panda",
        urdf="package://pybullet_data/franka_panda/panda.urdf",
        arm_joints=_JOINTS,
        tool_link="panda_grasptarget",
        home=(0.0, -pi / 4, 0.0, -3 * pi / 4, 0.0, pi / 2, pi / 4),
        fingers=ParallelGripper(
            joints=("panda_finger_joint1", "panda_finger_joint2"),
            links=("panda_hand", "panda_leftfinger", "panda_rightfinger"),
            max_opening=0.08,
            finger_reach=0.0264,
            closing_axis=(0.0, 1.0, 0.0),
            palm_height=0.039,
            tip_depth=0.0072,
            finger_width=0.021,
            palm_size=(0.208, 0.0632),
        ),
        joint_limits=dict(zip(_JOINTS, zip(_LOW, _HIGH, strict=True), strict=True)),
        max_acceleration=dict(zip(_JOINTS, _ACCELERATION, strict=True)),
        reach_from_above=(0.43, 0.77),
        may_touch=(("panda_link7", "panda_hand"),),
        mounted_links=("panda_link0",),
        source=(
            "Joint limits and accelerations: Franka Control Interface documentation, limits for the Franka Emika Robot "
            "(Panda), https://frankarobotics.github.io/docs/robot_specifications.html; the shipped URDF's limits are "
            "wider. Speeds: the shipped URDF's, which are the same as there. "
            "Home: where libfranka's examples start. Gripper: measured on the shipped collision meshes. "
            "Reach: tried on a grid of places, heights up to 0.1 m and turns of the hand."
        ),
    )
