"""A small robot for tests: a slide, two revolute joints and a gripper, of primitive shapes."""

from __future__ import annotations

from pathlib import Path

from llm3_bullet.robot import ParallelGripper, RobotDescription

URDF = """
<robot name="toy">
  <link name="rail"><inertial><mass value="1"/><origin xyz="0.1 0 0" rpy="0.2 0 0"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0 0.05"/><geometry><box size="0.2 0.3 0.1"/></geometry></collision></link>
  <link name="trunk"><inertial><mass value="1"/><origin xyz="0 0.02 0.1" rpy="0 0.3 0"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0 0.15"/><geometry><cylinder radius="0.04" length="0.3"/></geometry></collision>
    <collision><origin xyz="0.06 0 0.1" rpy="0.5 0 0"/><geometry><box size="0.06 0.04 0.1"/></geometry></collision>
  </link>
  <link name="upper"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0 0.15"/><geometry><box size="0.05 0.05 0.3"/></geometry></collision></link>
  <link name="lower"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0 0.15"/><geometry><capsule radius="0.03" length="0.2"/></geometry></collision></link>
  <link name="hand"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.05 0.16 0.04"/></geometry></collision></link>
  <link name="left"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0.01 0.04"/><geometry><box size="0.02 0.02 0.06"/></geometry></collision></link>
  <link name="right"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 -0.01 0.04"/><geometry><sphere radius="0.012"/></geometry></collision></link>
  <link name="tip"/>
  <joint name="slide" type="prismatic"><parent link="rail"/><child link="trunk"/><origin xyz="0 0 0.12"/>
    <axis xyz="1 0 0"/><limit lower="-0.3" upper="0.5" effort="1" velocity="1"/></joint>
  <joint name="shoulder" type="revolute"><parent link="trunk"/><child link="upper"/><origin xyz="0 0.08 0.3"/>
    <axis xyz="0 1 0"/><limit lower="-2.5" upper="2.5" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0 0.02 0.3"/>
    <axis xyz="0.6 0.8 0"/><limit lower="-2.5" upper="2.5" effort="1" velocity="1"/></joint>
  <joint name="wrist" type="fixed"><parent link="lower"/><child link="hand"/><origin xyz="0 0 0.31"/></joint>
  <joint name="left_finger" type="prismatic"><parent link="hand"/><child link="left"/>
    <axis xyz="0 1 0"/><limit lower="0" upper="0.04" effort="1" velocity="1"/></joint>
  <joint name="right_finger" type="prismatic"><parent link="hand"/><child link="right"/>
    <axis xyz="0 -1 0"/><limit lower="0" upper="0.04" effort="1" velocity="1"/></joint>
  <joint name="tip_joint" type="fixed"><parent link="hand"/><child link="tip"/><origin xyz="0 0 0.06"/></joint>
</robot>
"""


def toy_arm(folder: Path) -> RobotDescription:
    path = folder / "toy.urdf"
    path.write_text(URDF)
    return RobotDescription(
        name="toy",
        urdf=str(path),
        arm_joints=("slide", "shoulder", "elbow"),
        tool_link="tip",
        home=(0.0, 0.3, 0.3),
        fingers=ParallelGripper(
            joints=("left_finger", "right_finger"),
            links=("hand", "left", "right"),
            max_opening=0.08,
            finger_reach=0.02,
            closing_axis=(0.0, 1.0, 0.0),
            palm_height=0.04,
        ),
        may_touch=(("trunk", "lower"),),
        mounted_links=("rail",),
    )
