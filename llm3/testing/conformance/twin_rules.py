"""Rules for what a world has in common with others of its kind."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from llm3.interfaces import Env
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.look import Look, unlike
from llm3.testing.conformance.samples import samples
from llm3.testing.conformance.values import difference
from llm3.testing.conformance.world import Trial, World, applied, prepared
from llm3.types import MotionProblem

MADE = "Something is drawn or counted when a world is made: take all of it from the instance."
ASKED = 4
"""How many actions a world is asked about once more while another is there."""


def two_worlds_of_one_instance_are_equal(world: World) -> Iterator[Fault]:
    """A second world tells the same of itself."""
    if world.twin is not None:
        yield from departures(world.env, world.twin, world.again(world.trials), MADE)


def departures(env: Env, other: Env, trials: list[Trial], cause: str) -> Iterator[Fault]:
    """Where another world tells something else than this one."""
    if found := unlike(Look.at(env), Look.at(other)):
        yield Fault(f"a second world differs: {found}.", cause)
        return
    for trial in trials:
        if found := difference(trial.answer, prepared(other, trial.state, trial.action)):
            yield Fault(f"a second world prepares {trial} differently: {found}.", cause)
            return
        after = applied(other, trial)
        if after is not None and (found := difference(trial.transition, after)):
            yield Fault(f"a second world applies {trial} differently: {found}.", cause)
            return


@dataclass(frozen=True)
class Neighbour:
    """A world of another instance, and what it answered before the next world was made."""

    env: Env
    where: str
    look: Look
    trials: tuple[Trial, ...]
    answers: tuple[tuple[object, object], ...]
    """To each of the trials, with what is free."""

    @classmethod
    def of(cls, world: World, env: Env) -> Neighbour:
        """Ask this world, which is of the same instance as one that was looked at."""
        trials = tuple(world.trials[:ASKED])
        answers = tuple(_answered(env, trial) for trial in trials)
        return cls(env, world.where, Look.at(env), trials, answers)


def _answered(env: Env, trial: Trial) -> tuple[object, object]:
    answer = prepared(env, trial.state, trial.action)
    well = isinstance(answer, MotionProblem) and not trial.malformed
    return answer, np.asarray(answer.valid(samples(answer))) if well and isinstance(answer, MotionProblem) else None


def a_next_world_leaves_others_alone(neighbour: Neighbour) -> Iterator[Fault]:
    """Once a world of another instance is made, a world that was there answers as it did."""
    found = unlike(neighbour.look, Look.at(neighbour.env))
    for trial, (answer, mask) in zip(neighbour.trials, neighbour.answers, strict=True):
        again, now = _answered(neighbour.env, trial)
        found = found or difference(answer, again, str(trial)) or difference(mask, now, f"what is free for {trial}")
    if found:
        yield Fault(
            f"once the next world is made, one of {neighbour.where} answers differently: {found}.",
            "What a world has to itself is set in self: a class attribute or a global is the same for all worlds.",
        )


def closing_twice_does_no_harm(world: World) -> Iterator[Fault]:
    """A closed world can be closed again, and leaves another one as it was."""
    twin = world.twin
    answers = [(trial, prepared(twin, trial.state, trial.action)) for trial in world.trials[:2]] if twin else []
    world.env.close()
    world.env.close()
    for trial, answer in answers:
        found = difference(answer, prepared(twin, trial.state, trial.action)) if twin else ""
        if found:
            yield Fault(
                f"once one world is closed, another one prepares {trial} differently: {found}.",
                "Two worlds share something, such as a simulator: each needs its own.",
            )
            return


FOREIGN_RULES = (a_next_world_leaves_others_alone,)
"""Looked at before anything is done in the next world."""
RULES = (two_worlds_of_one_instance_are_equal,)
