"""Rules for what a world has in common with others of its kind."""

from __future__ import annotations

from collections.abc import Iterator

from llm3.interfaces import Env
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.values import difference
from llm3.testing.conformance.world import Trial, World, applied, prepared

MADE = "Something is drawn or counted when a world is made: take all of it from the instance."


def two_worlds_of_one_instance_are_equal(world: World) -> Iterator[Fault]:
    """A second world tells the same of itself."""
    if world.twin is not None:
        yield from departures(world.env, world.twin, world.trials, MADE)


def departures(env: Env, other: Env, trials: list[Trial], cause: str) -> Iterator[Fault]:
    """Where another world tells something else than this one."""
    for name in ("task", "schemas", "objects", "joints"):
        if found := difference(getattr(env, name), getattr(other, name), name):
            yield Fault(f"a second world differs: {found}.", cause)
            return
    start = env.reset()
    pairs = (
        ("reset", start, other.reset()),
        ("describe", env.describe(start), other.describe(start)),
        ("goal", env.goal(start), other.goal(start)),
    )
    for name, one, two in pairs:
        if found := difference(one, two, name):
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


RULES = (two_worlds_of_one_instance_are_equal,)
