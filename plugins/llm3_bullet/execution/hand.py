"""What a robot holds things with, once they have weight."""

from __future__ import annotations

from abc import ABC, abstractmethod

from llm3_bullet.execution.world import MotorWorld
from llm3_bullet.scene import Size


class Hand(ABC):
    """A gripper in a `MotorWorld`. What it is told to do, it begins to do: it takes time steps until it is done."""

    def __init__(self, world: MotorWorld) -> None:
        """Take the robot's gripper, which is open."""
        self.world = world

    def open_to(self, opening: float) -> None:
        """Move the fingers to this distance from each other, in metres."""

    def relax(self) -> None:
        """Back off from what stopped the fingers, unless they hold it."""

    @abstractmethod
    def take(self, name: str, size: Size) -> None:
        """Take a box, whether it is there or not."""

    @abstractmethod
    def let_go(self) -> None:
        """Let go of whatever is held."""

    @abstractmethod
    def held(self) -> str | None:
        """The box that is held now."""

    @abstractmethod
    def missed(self, name: str) -> str:
        """Why a box was not taken, such as ``"the fingers closed on nothing"``."""

    def look_after(self) -> None:
        """Is called after each time step."""
