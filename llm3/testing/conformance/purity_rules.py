"""Rules for a world that keeps nothing to itself: every answer depends on the arguments alone."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

import numpy as np

from llm3.interfaces import Env
from llm3.jsonio import dumps
from llm3.testing.conformance.inspection import Fault, Inspection, name_of
from llm3.testing.conformance.values import difference
from llm3.testing.conformance.world import Trial, World, applied, prepared

KEPT = "Keep nothing in the Env that a call changes: whatever a method needs stands in the State that it is given."
UNSEEDED = "It draws from another generator than rng, such as np.random, or counts its calls."

DRAWN = 6
"""Of how many states and actions it is asked whether chance is global."""


def global_generators() -> str:
    """The state of the generators that everybody shares, as a text to compare."""
    return repr((random.getstate(), np.random.get_state()))  # noqa: NPY002  # it is looked at, not drawn from


LOOKS = ("describe", "goal", "reset")
"""What is asked of the initial state; reset comes last, as it may heal what the others tell."""


def _looks(env: Env, world: World) -> tuple[object, ...]:
    return env.describe(world.start), env.goal(world.start), env.reset()


@contextmanager
def draws(what: str, where: str, inspection: Inspection) -> Iterator[None]:
    """Complain if what is done in the block draws from the generators that everybody shares."""
    before = global_generators()
    yield
    if global_generators() != before:
        inspection.complain(name_of(chance_comes_from_the_generator_that_is_given), _global(what), where)


def _global(what: str) -> Fault:
    return Fault(
        f"{what} draws from the global generator of random or numpy.",
        "Draw from the rng that prepare is given, or from one of the instance's own seed, and from nothing else.",
    )


def prepare_depends_on_its_arguments_alone(world: World) -> Iterator[Fault]:
    """The same state, action and seed give the same answer, whatever was called in between."""
    for trial in reversed(world.again(world.trials)):
        again = prepared(world.env, trial.state, trial.action)
        if found := difference(trial.answer, again):
            at_once = difference(again, prepared(world.env, trial.state, trial.action))
            text = f"prepare answers {trial} differently the second time: {at_once or found}."
            yield Fault(text, UNSEEDED if at_once else KEPT)
            return


def apply_depends_on_its_arguments_alone(world: World) -> Iterator[Fault]:
    """The same state, action and motion lead to the same state, whatever was called in between."""
    for trial in reversed(world.again(world.applied)):
        if trial.motion is not None:
            again = world.env.apply(trial.state, trial.action, trial.motion)
            if found := difference(trial.transition, again):
                yield Fault(f"apply answers {trial} differently the second time: {found}.", KEPT)
                return


def a_refused_action_changes_nothing(world: World) -> Iterator[Fault]:
    """After an action that failed, the world answers as before it."""
    others = [*world.applied[:1], *(trial for trial, _ in world.queries[:1])]
    world.env.reset()
    for trial in world.refused[: 1 if world.slow else 4]:
        before = _looks(world.env, world)
        prepared(world.env, trial.state, trial.action)
        after = _looks(world.env, world)
        for name, a, b in zip(LOOKS, before, after, strict=True):
            if found := difference(a, b):
                yield Fault(
                    f"{name} answers differently after {trial}, which was refused: {found}.",
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
    world.env.reset()
    before = _looks(world.env, world)
    for trial in world.again(world.applied):
        written = dumps(trial.state)
        prepared(world.env, trial.state, trial.action)
        if trial.motion is not None:
            world.env.apply(trial.state, trial.action, trial.motion)
        if dumps(trial.state) != written:
            text = f"{trial} changes the state that it is given: {written} becomes {dumps(trial.state)}."
            yield Fault(text, "apply answers a new State, and leaves the old one alone.")
        for name, a, b in zip(LOOKS, before, _looks(world.env, world), strict=True):
            if found := difference(a, b):
                yield Fault(f"{name} answers differently after {trial}: {found}.", KEPT)
                return


def chance_comes_from_the_generator_that_is_given(world: World) -> Iterator[Fault]:
    """No method draws from the generators that everybody shares."""
    for what, ask in _askings(world):
        before = global_generators()
        ask()
        if global_generators() != before:
            yield _global(what)
            return


def _askings(world: World) -> Iterator[tuple[str, Callable[[], object]]]:
    """Calls of all methods, and what each does in a sentence."""
    env = world.env
    for state in world.states[:DRAWN]:
        yield "describe", partial(env.describe, state)
        yield "goal", partial(env.goal, state)
    yield "reset", env.reset
    for trial in world.again(world.trials)[:DRAWN]:
        yield "preparing and applying actions", partial(_done, env, trial)


def _done(env: Env, trial: Trial) -> None:
    prepared(env, trial.state, trial.action)
    applied(env, trial)


RULES = (
    prepare_depends_on_its_arguments_alone,
    apply_depends_on_its_arguments_alone,
    a_refused_action_changes_nothing,
    nothing_is_changed_by_carrying_out,
    chance_comes_from_the_generator_that_is_given,
)
