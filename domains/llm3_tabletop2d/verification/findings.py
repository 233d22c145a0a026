"""Collects what is wrong with a plan, and what was looked at."""

from __future__ import annotations

from llm3.types import Defect, PlannedAction, Verification
from llm3_tabletop2d.verification.outlines import Array

TOUCHING = 0.0002
"""Things may be in one another by this much, in metres: states are rounded to half of it."""
HORIZON = 0.05
"""Distances from which on nothing is told, in metres."""


class Findings:
    """What a second look has found so far."""

    def __init__(self) -> None:
        self._defects: list[Defect] = []
        self._number, self._action, self._segment = 0, "", ""
        self._meant: tuple[str, ...] = ()
        self._configurations, self._deepest = 0, 0.0
        self._clearances: dict[str, float] = {}

    def begin_action(self, step: PlannedAction) -> None:
        """What is told from now on is about the next action."""
        self._number, self._action, self._segment = self._number + 1, str(step.action), ""
        self._meant = step.action.objects

    def begin_segment(self, label: str) -> None:
        """What is told from now on is about this piece of its motion; without a label, about the action again."""
        self._segment = label

    def end_actions(self) -> None:
        """What is told from now on is about the plan as a whole."""
        self._number, self._action = 0, ""

    def tell(self, sentence: str, waypoint: float | None = None, time: float | None = None, **measures: float) -> None:
        """Add a defect of where we are."""
        self._defects.append(
            Defect(sentence, self._number or None, self._action, self._segment, waypoint, time, measures)
        )

    def see(self, depths: dict[tuple[str, str], Array], places: Array, timed: bool = False) -> None:
        """Take in how deep things are in one another, at places of a segment (N,): waypoints or times."""
        self._configurations += len(places)
        for (mover, other), depth in depths.items():
            worst = int(depth.argmax())
            deep = float(depth[worst])
            self._deepest = max(self._deepest, deep)
            if -deep < HORIZON and self._segment and other not in self._meant:
                self._clearances[self._segment] = min(-deep, self._clearances.get(self._segment, HORIZON))
            if deep > TOUCHING:
                at = float(places[worst])
                sentence = f"{mover} is in {other}, {deep * 1000:.1f} mm deep"
                self.tell(sentence, None if timed else at, at if timed else None, depth=deep)

    def report(self) -> Verification:
        """All of it."""
        return Verification(tuple(self._defects), self._configurations, self._deepest, self._clearances)
