"""A second look at box-packing plans: each action does what it says, and the boxes end in the basket."""

from __future__ import annotations

import numpy as np

from llm3.interfaces import PlanVerifier
from llm3.types import Action, Defect, PlannedAction, State, Verification
from llm3_boxpack.actions import PICK, PLACE
from llm3_boxpack.instance import BoxpackInstance
from llm3_boxpack.layout import furniture
from llm3_bullet.clients import connect
from llm3_bullet.robot import RobotDescription
from llm3_bullet.scene import Box
from llm3_bullet.verification import PlainWorld, Playback
from llm3_bullet.verification.boxes import Frame, matrix

OUT_OF_BASKET = 0.001
"""How far a box may reach out of the basket, in metres."""
OFF_PLACE = 0.002
"""How far from the place that an action names a box may be let go, in metres."""
OFF_ANGLE = 0.01
"""How far a box may be turned from the angle that an action names, in radians."""


class BoxpackVerifier(PlanVerifier):
    """Plays plans of one instance."""

    def __init__(self, instance: BoxpackInstance, robot: RobotDescription, wall_height: float) -> None:
        """Take the problem.

        Args:
            instance: The boxes and the basket.
            robot: What packs them.
            wall_height: Height of the basket's walls in metres; 0 for none.
        """
        self._instance, self._robot, self._wall_height = instance, robot, wall_height

    def verify(self, start: State, actions: tuple[PlannedAction, ...]) -> Verification:
        """Play the plan in a world of its own."""
        names = [box.name for box in self._instance.boxes]
        if start.held or set(start.poses) != set(names):
            sentence = f"the plan must start with an empty gripper, and with the poses of {', '.join(names)}"
            return Verification((Defect(sentence),))
        boxes = (Box(box.name, box.size, start.poses[box.name]) for box in self._instance.boxes)
        fixed = furniture(self._instance.basket, self._wall_height)
        with connect() as client, np.errstate(over="ignore", invalid="ignore"):  # a broken plan may hold any number
            playback = Playback(PlainWorld(client, self._robot, fixed, boxes), start)
            for step in actions:
                playback.play(step)
                self._check_deed(playback, step.action)
            playback.findings.end_actions()
            self._check_goal(playback)
            return playback.findings.report()

    def _check_deed(self, playback: Playback, action: Action) -> None:
        """See that the motion did what the action says."""
        tell = playback.findings.tell
        if len(action.objects) != 1:
            return  # it is none of the domain's
        (name,) = action.objects
        if action.name == PICK.name and playback.world.held != name:
            tell(f"the gripper does not hold {name} after it")
        elif action.name == PICK.name and playback.let_go:
            tell(f"the gripper lets go of {', '.join(playback.let_go)}, and only takes something in a pick")
        elif action.name == PLACE.name and list(playback.let_go) != [name]:
            tell(f"the gripper does not let go of {name}")
        elif action.name == PLACE.name and set(action.params) == {"x", "y", "theta"}:
            x, y, angle = (action.params[key] for key in ("x", "y", "theta"))
            frame = playback.let_go[name]
            if np.hypot(frame[0][0] - x, frame[0][1] - y) > OFF_PLACE:
                tell(f"{name} is let go at ({frame[0][0]:.4f}, {frame[0][1]:.4f}), not at ({x:.4f}, {y:.4f})")
            turned = _angle(frame)
            if abs(np.angle(np.exp(1j * (turned - angle)))) > OFF_ANGLE:
                tell(f"{name} is let go at an angle of {turned:.3f} rad, not {angle:.3f} rad")

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


def _angle(frame: Frame) -> float:
    """The direction, seen from above, of the first axis of a box that is not its vertical one."""
    axes = matrix(frame[1])
    vertical = int(np.abs(axes[2]).argmax())
    first = 1 if vertical == 0 else 0
    return float(np.arctan2(axes[1, first], axes[0, first]))
