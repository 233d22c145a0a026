"""A second look at box-packing plans: each action does what it says, and the boxes end in the basket."""

from __future__ import annotations

import numpy as np

from llm3.interfaces import PlanVerifier
from llm3.types import Action, PlannedAction, State, Verification
from llm3_boxpack.actions import PICK, PLACE
from llm3_boxpack.instance import BoxpackInstance
from llm3_boxpack.layout import furniture
from llm3_bullet.robot import RobotDescription
from llm3_bullet.verification import Playback, check_let_go, check_pick, check_place, second_look

OUT_OF_BASKET = 0.001
"""How far a box may reach out of the basket, in metres."""


class BoxpackVerifier(PlanVerifier):
    """Plays plans of one instance."""

    def __init__(self, instance: BoxpackInstance, robot: RobotDescription, wall_height: float | None) -> None:
        """Take the problem.

        Args:
            instance: The boxes and the basket.
            robot: What packs them.
            wall_height: How high the basket's walls are, in metres; None for those of the problem.
        """
        self._instance, self._robot = instance.with_walls(wall_height), robot

    def verify(self, start: State, actions: tuple[PlannedAction, ...]) -> Verification:
        """Play the plan in a world of its own."""
        fixed = furniture(self._instance.basket)
        sizes = {thing.name: thing.size for thing in self._instance.things}
        return second_look(self._robot, fixed, sizes, start, actions, _check_deed, self._check_goal)

    def _check_goal(self, playback: Playback) -> None:
        center, size = np.array(self._instance.basket.center), np.array(self._instance.basket.size)
        for box in self._instance.boxes:
            if box.name == playback.world.held:
                playback.findings.tell(f"{box.name} ends in the gripper")
                continue
            corners = playback.world.corners(box.name)[:, :2]
            out = float((np.abs(corners - center) - size / 2).max())
            if out > OUT_OF_BASKET:
                playback.findings.tell(f"{box.name} ends {out * 1000:.1f} mm out of the basket", distance=out)


def _check_deed(playback: Playback, action: Action) -> None:
    """See that the motion did what the action says; what is none of the domain's, the core tells."""
    if len(action.objects) != 1:
        return
    (name,) = action.objects
    if action.name == PICK.name:
        check_pick(playback, name)
    elif action.name == PLACE.name and set(action.params) == {"x", "y", "theta"}:
        check_place(playback, name, **action.params)
    elif action.name == PLACE.name:
        check_let_go(playback, name)
