"""Collects what is wrong with a plan, and what was looked at."""

from __future__ import annotations

from llm3.types import Defect, PlannedAction, Verification
from llm3_bullet.verification.look import HORIZON, Look, Pair
from llm3_bullet.verification.sweep import CONTACT


def figure(value: float) -> str:
    """A number as it is told; those of a broken plan may have hundreds of digits."""
    return f"{value:.4f}" if abs(value) < 1e6 else f"{value:.4g}"


class Findings:
    """What a second look has found so far.

    A contact is told once for the waypoints of a segment, where it is deepest, and once for its trajectory.
    """

    def __init__(self) -> None:
        self._defects: list[Defect] = []
        self._number, self._action, self._segment = 0, "", ""
        self._configurations, self._deepest = 0, 0.0
        self._clearances: dict[str, float] = {}
        self._contacts: dict[tuple[Pair, bool], tuple[float, float | None, float | None]] = {}

    def begin_action(self, step: PlannedAction) -> None:
        """What is told from now on is about the next action."""
        self._number, self._action, self._segment = self._number + 1, str(step.action), ""

    def begin_segment(self, label: str) -> None:
        """What is told from now on is about this piece of the action's motion."""
        self._segment = label

    def end_segment(self) -> None:
        """Tell of the contacts on the segment; what is told from now on is about the action as a whole."""
        for (pair, _), (gap, waypoint, time) in self._contacts.items():
            first, second = pair.names
            self.tell(f"{first} touches {second}, {-gap * 1000:.2f} mm deep", waypoint, time, depth=-gap)
        self._contacts, self._segment = {}, ""

    def end_actions(self) -> None:
        """What is told from now on is about the plan as a whole."""
        self._number, self._action = 0, ""

    def tell(self, sentence: str, waypoint: float | None = None, time: float | None = None, **measures: float) -> None:
        """Add a defect of where we are: at a waypoint of the segment or between two, or at a time, or anywhere."""
        self._defects.append(
            Defect(sentence, self._number or None, self._action, self._segment, waypoint, time, measures)
        )

    def see(self, look: Look, waypoint: float | None = None, time: float | None = None) -> None:
        """Take in a look, made at a waypoint or between two, or at a time."""
        self._configurations += 1
        self._deepest = max(self._deepest, float(-look.gaps.min(initial=0.0)))
        clearance = look.clearance
        if clearance < HORIZON:
            self._clearances[self._segment] = min(clearance, self._clearances.get(self._segment, HORIZON))
        for index in (look.gaps < -CONTACT).nonzero()[0].tolist():
            key, gap = (look.pairs[index], time is None), float(look.gaps[index])
            if key not in self._contacts or gap < self._contacts[key][0]:
                self._contacts[key] = gap, waypoint, time

    def report(self) -> Verification:
        """All of it."""
        return Verification(tuple(self._defects), self._configurations, self._deepest, self._clearances)
