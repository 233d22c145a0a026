"""A motion problem's joint space as OMPL sees it."""

from __future__ import annotations

import numpy as np
from ompl import base

from llm3.interfaces import FreeSpace
from llm3.types import Vector

NARROWEST = 1e-6
"""The least range of a joint that OMPL is told; it knows no joint without one."""


class JointSpace:
    """Translates between configurations and OMPL's states, and answers OMPL's questions about them.

    OMPL's box holds the ends too, which may lie a little beyond the limits. What it makes of that is set back to the
    limits wherever it is read, before it is tested.

    OMPL samples a line at a fraction of the whole space's extent. Here a line is tested at the problem's own
    resolution instead, in batches.
    """

    def __init__(self, free_space: FreeSpace, low: Vector, high: Vector, ends: Vector) -> None:
        """Make the space of these limits.

        Args:
            free_space: Answers what is free.
            low: Lower joint limits, shape (dof,).
            high: Upper joint limits, shape (dof,).
            ends: The start and the goals, shape (N, dof). They are taken as they are, also beyond the limits.
        """
        self._free_space, self._low, self._high, self._ends = free_space, low, high, ends
        box_low, box_high = np.minimum(low, ends.min(axis=0)), np.maximum(high, ends.max(axis=0))
        bounds = base.RealVectorBounds(len(low))
        bounds.low, bounds.high = box_low.tolist(), np.maximum(box_high, box_low + NARROWEST).tolist()
        self._space = base.RealVectorStateSpace(len(low))
        self._space.setBounds(bounds)

    def information(self) -> base.SpaceInformation:
        """OMPL's view of the space.

        It keeps this object alive. The reverse would be a cycle through C++, which Python cannot free.
        """
        information = base.SpaceInformation(self._space)
        information.setStateValidityChecker(self.is_free)
        information.setMotionValidator(_MotionValidator(information, self))
        information.setup()
        return information

    def state(self, information: base.SpaceInformation, configuration: Vector) -> base.State:
        """The state of a configuration (dof,)."""
        state = information.allocState()
        state[0 : len(configuration)] = configuration.tolist()
        return state

    def configurations(self, *states: base.State) -> Vector:
        """The configurations of states, shape (N, dof): within the limits but for the ends."""
        found = np.array([state[0 : len(self._low)] for state in states])
        is_end = (found[:, None] == self._ends).all(axis=2).any(axis=1)
        return np.where(is_end[:, None], found, found.clip(self._low, self._high))

    def is_free(self, *states: base.State) -> bool:
        """Whether a state, or the straight line between two states, is free."""
        return self._free_space.path(self.configurations(*states))


class _MotionValidator(base.MotionValidator):  # type: ignore[misc]  # OMPL ships no types
    """Tests straight lines at the problem's resolution."""

    def __init__(self, information: base.SpaceInformation, space: JointSpace) -> None:
        super().__init__(information)
        self._space = space

    def checkMotion(self, first: base.State, second: base.State) -> bool:  # noqa: N802  # OMPL's name
        return self._space.is_free(first, second)
