"""Rules for what is taken, held and put down: nothing gets lost."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.values import configuration
from llm3.testing.conformance.world import World
from llm3.types import EventKind, Fact, Pose, State, Transition


def no_object_and_no_fact_gets_lost(world: World) -> Iterator[Fault]:
    """What stood or was held before an action stands, is held or is told of after it, and no fact is missed."""
    for trial in world.applied:
        if not isinstance(trial.transition, Transition):
            continue
        before, after = trial.state, trial.transition.state
        there = {*after.poses, *((after.held.object,) if after.held else ())}
        gone = {*before.poses, *((before.held.object,) if before.held else ())} - there
        dropped = {before.held.object} if before.held and after.held else set()  # no hand holds two
        for name in sorted(gone - (_told_of(world, after) - dropped) if gone else gone):
            yield Fault(
                f"after {trial} {name!r} is neither somewhere nor held.",
                "apply answers the whole next state: keep the poses of what did not move, and what is held.",
            )
        lost = {name: fact for name, fact in before.facts.items() if name not in after.facts}
        keep = "apply answers the whole next state: State(..., facts=state.facts) keeps them, with what changes put in."
        if lost and not after.facts:
            yield Fault(f"after {trial} all facts are gone: {lost}.", keep)
        elif lost and (missed := _missed(world, after, lost)):
            yield Fault(f"after {trial} the fact {missed!r} is gone, for which describe or goal asks.", keep)


def _told_of(world: World, state: State) -> set[str]:
    try:
        return {entity.name for entity in world.env.describe(state)}
    except (Exception, SystemExit):  # it may miss what was lost
        return set()


def _missed(world: World, state: State, lost: Mapping[str, Fact]) -> str:
    """The fact without which describe or goal raises something; empty where that is not so."""
    for ask in (world.env.describe, world.env.goal):
        try:
            ask(state)
        except KeyError as error:
            return next((name for name in lost if error.args == (name,)), "")
    return ""


def what_is_taken_was_somewhere(world: World) -> Iterator[Fault]:
    """What an action takes into the hand stood somewhere before; of worlds that keep no poses nothing is said."""
    if not world.start.poses:
        return
    for trial in world.applied:
        if trial.transition is None or trial.transition.state.held is None:
            continue
        before, name = trial.state, trial.transition.state.held.object
        if name not in before.poses and (before.held is None or before.held.object != name):
            yield Fault(
                f"{trial} picks up {name!r}, which stood nowhere.",
                "Any object can stand in any slot of an action: prepare refuses what makes no sense as a PRECONDITION.",
            )


def the_grip_is_what_the_events_say(world: World) -> Iterator[Fault]:
    """After an attach event the object is held, with that grasp; what is detached was held, and is not any more."""
    for trial in world.applied:
        events = [e for e in (trial.motion.events if trial.motion else ()) if e.kind is not EventKind.GRIPPER]
        if not events or trial.transition is None:
            continue
        last, held = events[-1], trial.transition.state.held
        name = held.object if held else None
        cause = "State.held and the events of the goal's pieces tell the same story."
        if last.kind is EventKind.ATTACH and name != last.object:
            yield Fault(f"{trial} ends with {last.object!r} attached, and the state after it holds {name!r}.", cause)
        elif last.kind is EventKind.ATTACH and held and last.grasp and not _alike(last.grasp, held.grasp):
            yield Fault(
                f"{trial} attaches {last.object!r} with the grasp {_pose(last.grasp)}, and the state after it holds it "
                f"with {_pose(held.grasp)}.",
                "Event.grasp and Held.grasp are the object's pose in the tool frame: the same one.",
            )
        if last.kind is EventKind.DETACH and name is not None and name == last.object:
            yield Fault(f"{trial} ends with {last.object!r} detached, and the state after it still holds it.", cause)
        in_hand = trial.state.held.object if trial.state.held else None
        for event in events:
            if event.kind is EventKind.DETACH and event.object is not None and event.object != in_hand:
                text = f"{trial} detaches {event.object!r}, and what is held is {in_hand!r}."
                yield Fault(text, "prepare refuses what cannot be let go of as a PRECONDITION.")
            in_hand = event.object if event.kind is EventKind.ATTACH else None


def _alike(one: Pose, other: Pose) -> bool:
    return np.allclose(one.position, other.position, atol=2e-4) and np.allclose(
        one.orientation, other.orientation, atol=2e-4
    )


def _pose(pose: Pose) -> str:
    return f"{configuration(pose.position)} {configuration(pose.orientation)}"


LOSSES = (no_object_and_no_fact_gets_lost, what_is_taken_was_somewhere)
"""Looked at before anything is asked of states that actions led to."""
RULES = (the_grip_is_what_the_events_say,)
"""Looked at once it is known what a world remembers."""
