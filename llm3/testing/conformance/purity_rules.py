"""Rules for a world that keeps nothing to itself: every answer depends on the arguments alone."""

from __future__ import annotations

import random
from collections.abc import Iterator

import numpy as np

from llm3.interfaces import Env
from llm3.jsonio import dumps
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.values import difference
from llm3.testing.conformance.world import World, applied, prepared

KEPT = "Keep nothing in the Env that a call changes: whatever a method needs stands in the State that it is given."
UNSEEDED = "It draws from another generator than rng, such as np.random, or counts its calls."


def global_generators() -> str:
    """The state of the generators that everybody shares, as a text to compare."""
    return repr((random.getstate(), np.random.get_state()))  # noqa: NPY002  # it is looked at, not drawn from


LOOKS = ("describe", "goal", "reset")
"""What is asked of the initial state; reset comes last, as it may heal what the others tell."""


def _looks(env: Env, world: World) -> tuple[object, ...]:
    return env.describe(world.start), env.goal(world.start), env.reset()


def prepare_depends_on_its_arguments_alone(world: World) -> Iterator[Fault]:
    """The same state, action and seed give the same answer, whatever was called in between."""
    for trial in reversed(world.trials):
        again = prepared(world.env, trial.state, trial.action)
        if found := difference(trial.answer, again):
            at_once = difference(again, prepared(world.env, trial.state, trial.action))
            text = f"prepare answers {trial} differently the second time: {at_once or found}."
            yield Fault(text, UNSEEDED if at_once else KEPT)
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
    world.env.reset()
    for trial in world.refused[:4]:
        before = _looks(world.env, world)
        prepared(world.env, trial.state, trial.action)
        after = _looks(world.env, world)
        for name, a, b in zip(LOOKS, before, after, strict=True):
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
    world.env.reset()
    before = _looks(world.env, world)
    for trial in world.applied:
        written = dumps(trial.state)
        prepared(world.env, trial.state, trial.action)
        if trial.motion is not None:
            world.env.apply(trial.state, trial.action, trial.motion)
        if dumps(trial.state) != written:
            text = f"{trial} changes the state that it is given: {written} becomes {dumps(trial.state)}."
            yield Fault(text, "apply answers a new State, and leaves the old one alone.")
        for name, a, b in zip(LOOKS, before, _looks(world.env, world), strict=True):
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


def a_new_world_answers_like_one_in_use(world: World) -> Iterator[Fault]:
    """Asked in another order, and before anything is carried out there, a new world answers the same."""
    if world.twin is None:
        return
    world.twin.reset()
    for number, trial in reversed(list(enumerate(world.trials))):
        found = difference(prepared(world.twin, trial.state, trial.action), trial.answer)
        if not found:
            continue
        for earlier in world.trials[:number]:
            prepared(world.twin, earlier.state, earlier.action)
            applied(world.twin, earlier)
        if not difference(prepared(world.twin, trial.state, trial.action), trial.answer):  # or it was made differently
            text = f"a new world prepares {trial} differently than one in which actions were carried out: {found}."
            yield Fault(text, KEPT)
        return


RULES = (
    prepare_depends_on_its_arguments_alone,
    apply_depends_on_its_arguments_alone,
    a_refused_action_changes_nothing,
    nothing_is_changed_by_carrying_out,
    chance_comes_from_the_generator_that_is_given,
    a_new_world_answers_like_one_in_use,
)
