"""The layouts that a recorded run tried, seen from above."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from llm3.assembly.choices import settle_options
from llm3.jsonio import dumps, loads
from llm3.playback import seen_from_above
from llm3.records import read_events, read_run
from llm3.registry import Registry
from llm3.types import ActionTried, AttemptEnded, RunStarted, Shape, State

Shapes = tuple[Shape, ...]
STILL = 0.001
"""Metres: what moved less stands where it stood."""


@dataclass(frozen=True)
class Tried:
    """What a run tried."""

    start: Shapes
    attempts: tuple[Shapes, ...]
    """What each attempt moved to where, at its end."""
    solved: bool
    """Whether the last attempt is a solution."""


def tried_layouts(registry: Registry, folder: Path) -> Tried | None:
    """Read the layouts of a run from its record; None if its domain has no view from above.

    Raises:
        LLM3Error: The record does not have the documented form, or its domain is not there.
    """
    file = read_run(folder)
    domain = registry.domain(file.config.domain)
    instance = loads(dumps(file.instance), domain.instance_type, f"{folder / 'run.json'}, instance")
    start, ends = _states(folder)
    options = settle_options(domain, file.options)

    def view(state: State) -> Shapes | None:
        return seen_from_above(domain, instance, options, state)

    first = view(start)
    if first is None:
        return None
    attempts = tuple(_moved(first, view(state) or ()) for state in ends)
    return Tried(first, attempts, file.status == "solved")


def _states(folder: Path) -> tuple[State, list[State]]:
    """Where the run began, and where each attempt ended."""
    start = state = State()
    ends = []
    for recorded in read_events(folder):
        event = recorded.event
        if isinstance(event, RunStarted):
            start = state = event.state
        elif isinstance(event, ActionTried):
            state = event.step.state if event.step else event.before
        elif isinstance(event, AttemptEnded):
            ends.append(state)
            state = start
    return start, ends


def _moved(start: Shapes, shapes: Iterable[Shape]) -> Shapes:
    before = {shape.name: shape for shape in start}
    things = (shape for shape in shapes if not shape.robot)
    return tuple(s for s in things if s.name not in before or _far(_extent(s), _extent(before[s.name])))


def _extent(shape: Shape) -> tuple[float, ...]:
    x, y = zip(*shape.corners, strict=True)
    return min(x), max(x), min(y), max(y)


def _far(one: tuple[float, ...], other: tuple[float, ...]) -> bool:
    return any(abs(a - b) > STILL for a, b in zip(one, other, strict=True))
