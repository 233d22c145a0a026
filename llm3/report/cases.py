"""What went wrong in the attempts of a run, and what is to be seen of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from llm3.playback import Evidence, evidence, touching
from llm3.report.drawing import Drawing, Window, drawing, nearer, window_around
from llm3.report.sights import Sights
from llm3.report.story import Turn
from llm3.types import Moment, Shape, State, moment_of


@dataclass(frozen=True)
class Case:
    """An attempt, and the evidence of its failure."""

    turn: Turn
    evidence: Evidence | None
    """None where every action could be done, or no action was tried."""

    @property
    def moment(self) -> Moment | None:
        """Where it failed, or else where it led; None where nothing was tried."""
        if self.evidence:
            return self.evidence.moment
        return moment_of(self.turn.steps[-1].state) if self.turn.steps else None

    @property
    def is_placed(self) -> bool:
        """Whether the failure is one of a certain configuration of the robot."""
        return bool(self.evidence and self.evidence.failure.configuration)


def cases(turns: Iterable[Turn], robot: Sequence[str]) -> Iterator[Case]:
    """The case of each attempt.

    Args:
        turns: The attempts.
        robot: The names of the robot's parts.
    """
    for turn in turns:
        yield Case(turn, evidence(turn.failed, turn.steps, robot) if turn.failed else None)


def common_window(start: State, cases: Iterable[Case], sights: Sights) -> Window | None:
    """One window for all drawings, so that they can be compared; None where nothing is seen from above."""
    if sights.view is None:
        return None
    moments = [moment_of(start), *(moment for case in cases if (moment := case.moment))]
    shapes: list[Shape] = [shape for moment in moments for shape in sights.view(moment)]
    return window_around(shapes)


def case_drawing(case: Case, window: Window | None, sights: Sights) -> Drawing | None:
    """An attempt from above: where it failed, with what touches marked, or where it led."""
    if sights.view is None or window is None or case.moment is None:
        return None
    shapes, found = sights.view(case.moment), case.evidence
    title = f"Attempt {case.turn.number}, seen from above: {_what_is_seen(case)}."
    if found is None:
        return drawing(title, window, shapes)
    names = touching(found.touches)
    close = nearer(window, shapes, names) if names else window
    return drawing(title, close, shapes, found.touches, found.failure.objects)


def _what_is_seen(case: Case) -> str:
    if case.evidence is None:
        return "where it led"
    number = len(case.turn.tried)
    if case.evidence.touches:
        return f"what touches where action {number} failed"
    return f"where action {number} should have led" if case.is_placed else f"before action {number}, which failed"
