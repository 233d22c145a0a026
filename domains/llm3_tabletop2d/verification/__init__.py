"""A second look at plans: each action does what it says, nothing is touched, and everything ends where it belongs.

It shares no geometry with the world: outlines are points here, and what is deeper than about a millimetre is seen.
"""

from __future__ import annotations

import numpy as np

from llm3.interfaces import PlanVerifier
from llm3.types import Action, Defect, PlannedAction, State, Verification
from llm3_tabletop2d.instance import TabletopInstance
from llm3_tabletop2d.verification.outlines import Array
from llm3_tabletop2d.verification.playback import SAME, Playback
from llm3_tabletop2d.verification.world import World

__all__ = ["TabletopVerifier"]

OUT_OF_REGION = 0.001
"""How far an outline may reach out of its region, in metres."""


class TabletopVerifier(PlanVerifier):
    """Plays plans of one instance."""

    def __init__(self, instance: TabletopInstance, radius: float, max_velocity: float, max_acceleration: float) -> None:
        """Take the problem.

        Args:
            instance: What stands where.
            radius: The robot's, in metres.
            max_velocity: Of both joints, in m/s.
            max_acceleration: Of both joints, in m/s².
        """
        self._instance, self._radius = instance, radius
        self._limits = max_velocity, max_acceleration

    def verify(self, start: State, actions: tuple[PlannedAction, ...]) -> Verification:
        """Play the plan."""
        names = [item.name for item in self._instance.objects]
        if start.held or set(start.poses) != set(names):
            return Verification(
                (Defect(f"the plan must start with nothing held, and with the poses of {', '.join(names)}"),)
            )
        with np.errstate(over="ignore", invalid="ignore"):  # a broken plan may hold any number
            playback = Playback(World(self._instance, self._radius, start), *self._limits)
            for step in actions:
                before = dict(playback.world.centers)
                playback.play(step)
                _check_deed(playback, step.action)
                _check_others(playback, before, step.action)
            playback.findings.end_actions()
            self._check_goal(playback)
            return playback.findings.report()

    def _check_goal(self, playback: Playback) -> None:
        for item in self._instance.objects:
            region = self._instance.region_of(item.name)
            if region is None:
                continue
            if item.name == playback.world.held:
                playback.findings.tell(f"{item.name} ends in the robot's hold")
                continue
            points = playback.world.objects[item.name].points + playback.world.centers[item.name]
            out = float((np.abs(points - region.center) - np.array(region.size) / 2).max())
            if out > OUT_OF_REGION:
                playback.findings.tell(f"{item.name} ends {out * 1000:.1f} mm out of {region.name}", distance=out)


def _check_deed(playback: Playback, action: Action) -> None:
    """See that the motion did what the action says."""
    tell, world = playback.findings.tell, playback.world
    if len(action.objects) != 1 or action.objects[0] not in world.objects:
        return  # it is none of the domain's
    (name,) = action.objects
    if action.name == "pick":
        if world.held != name:
            tell(f"the robot does not hold {name} after it")
        if playback.let_go:
            tell(f"the robot lets go of {', '.join(playback.let_go)}, and only takes something in a pick")
        return
    if world.held:
        tell(f"the robot holds {world.held} after it")
    if action.name == "push" and not playback.behind:
        tell(f"the robot is not behind {name} where it moves it")
    if set(action.params) == {"x", "y"}:
        x, y = world.centers[name]
        if np.hypot(x - action.params["x"], y - action.params["y"]) > SAME:
            tell(f"{name} is at ({x:.4f}, {y:.4f}), not at ({action.params['x']:.4f}, {action.params['y']:.4f})")


def _check_others(playback: Playback, before: dict[str, Array], action: Action) -> None:
    """See that nothing else was moved."""
    for name, center in before.items():
        if name not in action.objects and np.linalg.norm(playback.world.centers[name] - center) > SAME:
            playback.findings.tell(f"{name} was moved, and the action is about something else")
