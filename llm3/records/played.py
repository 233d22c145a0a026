"""What a record holds that can be played: the plan, or what was carried out of an attempt."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

from llm3.assembly.choices import settle_options
from llm3.errors import UsageError
from llm3.interfaces import Domain, Options
from llm3.jsonio import dumps, loads
from llm3.records.event_reader import read_events
from llm3.records.plan import read_plan
from llm3.records.run_file import RunFile, read_run
from llm3.registry import Registry
from llm3.types import ActionTried, AttemptEnded, PlannedAction, RunStarted, State


@dataclass(frozen=True)
class Played:
    """A problem, and actions that were found feasible in it."""

    domain: Domain
    instance: Any
    options: Options
    start: State
    steps: tuple[PlannedAction, ...]


def read_played(registry: Registry, path: Path, attempt: int | None = None) -> Played:
    """Read a plan, or an attempt of a run.

    Args:
        registry: Where the domain comes from.
        path: A plan.json, or the folder of a run.
        attempt: The number of an attempt, from 1; None for the plan.

    Raises:
        UnknownName: There is no such domain, or it has no such option.
        UsageError: There is no such attempt.
        InputError: The record does not have the documented form.
    """
    if attempt is None:
        plan = read_plan(path)
        return _played(registry, plan.domain, plan.instance, plan.options, "the plan's", plan.start, plan.actions)
    run = read_run(path)
    start, steps = _attempt(path, attempt)
    return played_of(registry, path, run, start, steps)


def played_of(registry: Registry, folder: Path, run: RunFile, start: State, steps: tuple[PlannedAction, ...]) -> Played:
    """What a run carried out, where it is known already.

    Args:
        registry: Where the domain comes from.
        folder: The run's, for messages.
        run: What was asked.
        start: Where it began.
        steps: What was carried out.

    Raises:
        UnknownName: There is no such domain, or it has no such option.
        InputError: The instance is none of the domain's.
    """
    return _played(registry, run.config.domain, run.instance, run.options, f"{folder / 'run.json'},", start, steps)


def _played(
    registry: Registry,
    name: str,
    instance: Any,
    options: Options,
    owner: str,
    start: State,
    steps: tuple[PlannedAction, ...],
) -> Played:
    domain = registry.domain(name)
    problem = loads(dumps(instance), domain.instance_type, f"{owner} instance")
    return Played(domain, problem, settle_options(domain, options), start, steps)


def _attempt(folder: Path, number: int) -> tuple[State, tuple[PlannedAction, ...]]:
    start, steps, ended = State(), [], 0
    for recorded in read_events(folder):
        event = recorded.event
        if isinstance(event, RunStarted):
            start = event.state
        elif isinstance(event, ActionTried) and event.attempt == number and event.step:
            steps.append(event.step)
        elif isinstance(event, AttemptEnded):
            ended = event.attempt.number
            if ended == number:
                return start, tuple(steps)
    raise UsageError(f"{folder} has no attempt {number}: {f'the last one is {ended}' if ended else 'none has ended'}.")
