"""The hand that a robot has."""

from __future__ import annotations

from llm3_bullet.execution.cup import Cup
from llm3_bullet.execution.fingers import Fingers
from llm3_bullet.execution.hand import Hand
from llm3_bullet.execution.world import MotorWorld
from llm3_bullet.robot import SuctionGripper


def hand_of(world: MotorWorld) -> Hand:
    """What the robot of a world holds things with."""
    gripper = world.model.description.gripper
    return Cup(world, gripper) if isinstance(gripper, SuctionGripper) else Fingers(world, gripper)
