"""How well a robot follows its plan."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from llm3_bullet.kinematics import Kinematics
from llm3_bullet.poses import Array


@dataclass
class Tracking:
    """Adds up errors."""

    joint: float = 0.0
    """The largest of a joint, in radians or metres."""
    tool: float = 0.0
    """The largest of the tool, in metres."""
    squares: float = 0.0
    """The sum of the squares of the joints'."""
    count: int = 0
    """How many these are."""

    @property
    def rms(self) -> float:
        """The root of the mean square of the joints'."""
        return float(np.sqrt(self.squares / self.count)) if self.count else 0.0

    def add(self, read: Array, true: Array, meant: Array, kinematics: Kinematics) -> None:
        """See a piece of motion.

        Args:
            read: The configurations as encoders tell them, (N, dof).
            true: The configurations, (N, dof).
            meant: The planned ones, (N, dof).
            kinematics: The robot's.
        """
        errors = np.abs(read - meant)
        apart = kinematics.tool(true)[:, :3, 3] - kinematics.tool(meant)[:, :3, 3]
        self.joint = max(self.joint, float(errors.max()))
        self.tool = max(self.tool, float(np.linalg.norm(apart, axis=1).max()))
        self.squares += float((errors**2).sum())
        self.count += errors.size
