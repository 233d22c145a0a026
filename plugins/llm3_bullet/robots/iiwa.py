"""The KUKA LBR iiwa 14 R820 of pybullet_data, on a pedestal, with a suction tool of ours on its flange."""

from __future__ import annotations

from math import pi, radians

from llm3.types import Pose
from llm3_bullet.robot import Attachment, RobotDescription, SuctionGripper

_JOINTS = tuple(f"lbr_iiwa_joint_{i}" for i in range(1, 8))
_PEDESTAL = 0.2  # its height in metres: on the table, the elbow could not fold far enough for what lies near
_FLANGE = 0.045  # from the last joint's frame, in metres
_DEGREES_PER_SECOND = (85, 85, 100, 75, 130, 135, 135)


def iiwa() -> RobotDescription:
    """The iiwa."""
    return RobotDescription(
        name="iiwa",
        urdf="package://pybullet_data/kuka_iiwa/model.urdf",
        arm_joints=_JOINTS,
        tool_link="suction_tip",
        home=(0.0, pi / 6, 0.0, -pi / 2, 0.0, pi / 3, 0.0),
        suction=SuctionGripper(links=("suction_plate", "suction_tube", "suction_cup"), cup_radius=0.014),
        base=Pose((0.0, 0.0, _PEDESTAL)),
        attachments=(
            Attachment(
                urdf="package://llm3_bullet/robots/suction_tool.urdf",
                link="lbr_iiwa_link_7",
                pose=Pose((0.0, 0.0, _FLANGE)),
            ),
            Attachment(
                urdf="package://llm3_bullet/robots/pedestal.urdf",
                link="lbr_iiwa_link_0",
                pose=Pose((0.0, 0.0, -_PEDESTAL)),
            ),
        ),
        max_velocity=dict(zip(_JOINTS, map(radians, _DEGREES_PER_SECOND), strict=True)),
        max_acceleration=dict.fromkeys(_JOINTS, 5.0),
        mounted_links=("pedestal",),
        source=(
            "Joint limits: the shipped URDF's, which are the data sheet's. Speeds: KUKA, LBR iiwa 14 R820, data "
            "sheet; the shipped URDF says 10 rad/s. Accelerations: KUKA publishes none; 5 rad/s² is a cautious choice. "
            "Flange: 126 mm beyond the wrist, data sheet."
        ),
    )
