"""Rules for a world that keeps nothing to itself: every answer depends on the arguments alone."""

from __future__ import annotations

import random
from collections.abc import Iterator

import numpy as np

from llm3.interfaces import Env
from llm3.jsonio import dumps
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.values import difference, samples
from llm3.testing.conformance.world import Trial, World, prepared

KEPT = "Keep nothing in the Env that a call changes: whatever a method needs stands in the State that it is given."
UNSEEDED = "It draws from another generator than rng, such as np.random, or counts its calls."
MADE = "Something is drawn or counted when a world is made: take all of it from the instance."


def global_generators() -> str:
    """The state of the generators that everybody shares, as a text to compare."""
    return repr((random.getstate(), np.random.get_state()))  # noqa: NPY002  # it is looked at, not drawn from


def _looks(env: Env, world: World) -> tuple[object, ...]:
    return env.reset(), env.describe(world.start), env.goal(world.start)


def prepare_depends_on_its_arguments_alone(world: World) -> Iterator[Fault]:
    """The same state, action and seed give the same answer, whatever was called in between."""
    for trial in reversed(world.trials):
        again = prepared(world.env, trial.state, trial.action)
        if found := difference(trial.answer, again):
            at_once = difference(again, prepared(world.env, trial.state, trial.action))
            text = f"prepare answers {trial} differently the second time: {at_once or found}."
            yield Fault(text, UNSEEDED if at_once else KEPT)
            return


def a_motion_problem_stays_what_it_is(world: World) -> Iterator[Fault]:
    """What a motion problem says is free does not change when something else is prepared."""
    for trial, problem in world.queries:
        now = np.asarray(problem.valid(samples(problem)))
        if trial.mask is not None and not np.array_equal(now, trial.mask):
            yield Fault(
                f"the validity test of {trial} answers differently once other actions were prepared.",
                "valid looks at what the Env or its simulator holds now: bind it to the state of its own prepare.",
            )
            return


def apply_depends_on_its_arguments_alone(world: World) -> Iterator[Fault]:
    """The same state, action and motion lead to the same state, whatever was called in between."""
    for trial in reversed(world.applied):
        if trial.motion is not None:
            again = world.env.apply(trial.state, trial.action, trial.motion)
            if found := difference(trial.transition, again):
                yield Fault(f"apply answers {trial} differently the second time: {found}.", KEPT)
                return


def a_refused_action_changes_nothing(world: World) -> Iterator[Fault]:
    """After an action that failed, the world answers as before it."""
    others = [*world.applied[:1], *(trial for trial, _ in world.queries[:1])]
    for trial in world.refused[:4]:
        before = _looks(world.env, world)
        prepared(world.env, trial.state, trial.action)
        after = _looks(world.env, world)
        for name, a, b in zip(("reset", "describe", "goal"), before, after, strict=True):
            if a != b:
                yield Fault(
                    f"{name} answers differently after {trial}, which was refused: {difference(a, b)}.",
                    "prepare only asks: it changes nothing, least of all before it refuses.",
                )
                return
        for other in others:
            prepared(world.env, trial.state, trial.action)
            if found := difference(other.answer, prepared(world.env, other.state, other.action)):
                yield Fault(f"{other} is answered differently after {trial}, which was refused: {found}.", KEPT)
                return


def nothing_is_changed_by_carrying_out(world: World) -> Iterator[Fault]:
    """Neither prepare nor apply changes the state that it is given, nor what reset, describe and goal answer."""
    before = _looks(world.env, world)
    for trial in world.applied:
        written = dumps(trial.state)
        prepared(world.env, trial.state, trial.action)
        if trial.motion is not None:
            world.env.apply(trial.state, trial.action, trial.motion)
        if dumps(trial.state) != written:
            text = f"{trial} changes the state that it is given: {written} becomes {dumps(trial.state)}."
            yield Fault(text, "apply answers a new State, and leaves the old one alone.")
        for name, a, b in zip(("reset", "describe", "goal"), before, _looks(world.env, world), strict=True):
            if a != b:
                yield Fault(f"{name} answers differently after {trial}: {difference(a, b)}.", KEPT)
                return


def chance_comes_from_the_generator_that_is_given(world: World) -> Iterator[Fault]:
    """No method draws from the generators that everybody shares."""
    before = global_generators()
    for trial in world.trials[:6]:
        prepared(world.env, trial.state, trial.action)
        if trial.motion is not None and trial.transition is not None:
            world.env.apply(trial.state, trial.action, trial.motion)
    if global_generators() != before:
        yield Fault(
            "preparing and applying actions draws from the global generator of random or numpy.",
            "Draw from the rng that prepare is given, and from nothing else.",
        )


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
        if trial.motion is None or trial.transition is None:
            continue
        if found := difference(trial.transition, other.apply(trial.state, trial.action, trial.motion)):
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


RULES = (
    prepare_depends_on_its_arguments_alone,
    a_motion_problem_stays_what_it_is,
    apply_depends_on_its_arguments_alone,
    a_refused_action_changes_nothing,
    nothing_is_changed_by_carrying_out,
    chance_comes_from_the_generator_that_is_given,
    two_worlds_of_one_instance_are_equal,
)
