"""An arm as awkward as URDF allows: oblique axes, a sliding and a limitless joint, links that branch off everywhere."""

from __future__ import annotations

from llm3_bullet.robot import ParallelGripper, RobotDescription

LINKS = ("tip", "base", "wrist", "camera", "arm", "left", "right", "mast", "drawer", "flap", "lens")
JOINTS = """
  <joint name="zoom" type="fixed"><parent link="camera"/><child link="lens"/>
    <origin xyz="0 0.1 0" rpy="1 2 3"/></joint>
  <joint name="j1" type="revolute"><parent link="base"/><child link="arm"/>
    <origin xyz="0.1 -0.2 0.3" rpy="0.4 0.5 -0.6"/>
    <axis xyz="0 0 -2"/><limit lower="-3" upper="2" effort="1" velocity="1"/></joint>
  <joint name="pole" type="fixed"><parent link="base"/><child link="mast"/><origin xyz="-0.2 0 0.5"/></joint>
  <joint name="j2" type="prismatic"><parent link="arm"/><child link="drawer"/><origin rpy="0 -1.2 0.3"/>
    <axis xyz="0.6 0.8 0"/><limit lower="-0.1" upper="0.4" effort="1" velocity="1"/></joint>
  <joint name="lid" type="revolute"><parent link="arm"/><child link="flap"/><origin xyz="0 0 0.2"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="j3" type="continuous"><parent link="drawer"/><child link="wrist"/><origin xyz="0.3 0 0"/></joint>
  <joint name="hold" type="fixed"><parent link="drawer"/><child link="camera"/>
    <origin xyz="0 0.1 0.1" rpy="0 0 1"/></joint>
  <joint name="f1" type="prismatic"><parent link="wrist"/><child link="left"/>
    <origin xyz="0 0 0.1" rpy="0.3 0 0"/>
    <axis xyz="0 1 0"/><limit lower="0" upper="0.03" effort="1" velocity="1"/></joint>
  <joint name="f2" type="prismatic"><parent link="wrist"/><child link="right"/><origin xyz="0 0 0.1"/>
    <axis xyz="0 -1 0"/><limit lower="0" upper="0.03" effort="1" velocity="1"/></joint>
  <joint name="end" type="fixed"><parent link="wrist"/><child link="tip"/>
    <origin xyz="0.02 0 0.2" rpy="0 0.7 0"/></joint>
"""
IN_PYBULLETS_ORDER = ("base", "arm", "drawer", "wrist", "left", "right", "tip", "camera", "lens", "flap", "mast")


def urdf(joints=JOINTS, links=LINKS):
    inertia = '<mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
    bodies = "".join(f'<link name="{name}"><inertial>{inertia}</inertial></link>' for name in links)
    return f'<robot name="branching">{bodies}{joints}</robot>'


def branching_arm(folder, text=None, **overrides):
    path = folder / "branching.urdf"
    path.write_text(urdf() if text is None else text)
    fields = {
        "name": "branching",
        "urdf": str(path),
        "arm_joints": ("j1", "j2", "j3"),
        "tool_link": "tip",
        "home": (0.0, 0.1, 0.2),
        "joint_limits": {"j3": (-2.0, 4.0)},
        "fingers": ParallelGripper(
            joints=("f1", "f2"),
            links=("left", "right"),
            max_opening=0.06,
            finger_reach=0.02,
            closing_axis=(0.0, 1.0, 0.0),
            palm_height=0.1,
        ),
    }
    return RobotDescription(**{**fields, **overrides})
