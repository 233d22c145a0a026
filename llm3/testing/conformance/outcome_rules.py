"""Rules for what becomes of actions: failures, transitions."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.values import configuration, programmer_talk
from llm3.testing.conformance.world import World
from llm3.types import (
    ITSELF,
    Failure,
    FailureKind,
    MotionProblem,
    NoMotion,
    State,
    Transition,
)

KINDS = (
    FailureKind.PRECONDITION,
    FailureKind.UNREACHABLE,
    FailureKind.GOAL_IN_COLLISION,
    FailureKind.START_IN_COLLISION,
)
"""What prepare may answer: the others belong to the planner and the parser."""


def prepare_answers_what_it_may(world: World) -> Iterator[Fault]:
    """The answer of prepare is a MotionProblem, a NoMotion, or a Failure of a kind that is the Env's to tell."""
    for trial in world.trials:
        answer = trial.answer
        if not isinstance(answer, MotionProblem | NoMotion | Failure):
            yield Fault(
                f"prepare answers {trial} with {answer!r}.",
                "Every way through prepare must return: a MotionProblem, a NoMotion or a Failure.",
            )
        elif isinstance(answer, Failure) and answer.kind not in KINDS:
            yield Fault(
                f"prepare answers {trial} with the failure {answer.kind.value!r}.",
                f"An Env tells {', '.join(k.value for k in KINDS)}; the planner and the parser tell the others.",
            )


def failures_say_why(world: World) -> Iterator[Fault]:
    """A failure that prepare answers has a sentence or names what is to blame, in words for a model."""
    for trial in world.trials:
        failure = trial.answer
        if not isinstance(failure, Failure):
            continue
        if failure.kind is FailureKind.PRECONDITION and not failure.detail.strip():
            yield Fault(
                f"{trial} fails for a precondition, and does not say which.",
                "Failure.detail is the sentence that the model reads: say what would have to be true.",
            )
        blamed = failure.objects or failure.contacts or failure.detail.strip()
        if failure.kind in (FailureKind.GOAL_IN_COLLISION, FailureKind.START_IN_COLLISION) and not blamed:
            yield Fault(
                f"{trial} fails with {failure.kind.value!r}, and does not say with what.",
                "Name the objects in Failure.objects: the model can only move away what it knows of.",
            )
        if talk := programmer_talk(failure.detail):
            yield Fault(
                f"the failure of {trial} holds {talk!r}: {failure.detail}.", "Failure.detail is read by a model."
            )


def failures_name_what_the_model_knows(world: World) -> Iterator[Fault]:
    """What a failure blames is an object, an entity of the description, or a word of the task."""
    task = world.env.task.lower()
    known = {ITSELF, *world.env.objects, *(entity.name for entity in world.env.describe(world.start))}
    for trial in world.refused:
        failure = trial.failure
        names = (*failure.objects, *(contact.object for contact in failure.contacts)) if failure else ()
        for name in names:
            if name not in known and name.lower() not in task:
                yield Fault(
                    f"the failure of {trial} blames {name!r}, which neither the description nor the task names.",
                    f"The model knows {', '.join(sorted(known - {ITSELF}))}: call things by these names.",
                )


def apply_answers_a_transition(world: World) -> Iterator[Fault]:
    """The answer of apply is a Transition to a State, with notes for a model."""
    for trial in world.applied:
        transition = trial.transition
        if not isinstance(transition, Transition) or not isinstance(transition.state, State):
            yield Fault(f"apply answers {trial} with {transition!r}.", "It answers Transition(state, notes).")
            return
        for note in transition.notes:
            if not note.strip() or programmer_talk(note):
                yield Fault(f"a note on {trial} is {note!r}.", "Notes are sentences that every model reads.")


def the_robot_is_where_its_motion_ends(world: World) -> Iterator[Fault]:
    """After a motion the state's configuration is its end, and without one it is what it was."""
    for trial in world.applied:
        if trial.transition is None or trial.motion is None:
            continue
        after = trial.transition.state.configuration
        end = trial.motion.end if trial.motion.segments else trial.state.configuration
        if len(after) != len(end) or not np.allclose(after, end, rtol=0, atol=2e-4):
            what = "its motion ends" if trial.motion.segments else "it was, as there is no motion"
            yield Fault(
                f"after {trial} the robot is at {configuration(after)}, and {what} at {configuration(end)}.",
                "apply takes the configuration from motion.end, and from the state where nothing moves.",
            )


def something_can_be_done(world: World) -> Iterator[Fault]:
    """Of all actions that are tried, some can be carried out."""
    if world.trials and not world.applied and not world.malformed and world.helpers.planner is not None:
        kinds = sorted({trial.failure.kind.value for trial in world.refused if trial.failure})
        yield Fault(
            f"none of {len(world.trials)} actions could be carried out: {', '.join(kinds)}.",
            "The ranges of the schemas may be far wider than what works: give regions, or look at prepare.",
        )


FORM_RULES = (apply_answers_a_transition,)
"""Looked at before anything else is asked of what actions led to."""
RULES = (
    prepare_answers_what_it_may,
    failures_say_why,
    failures_name_what_the_model_knows,
    the_robot_is_where_its_motion_ends,
)
LAST_RULES = (something_can_be_done,)
"""Looked at once it is known what a world remembers, and what is wrong with its motion problems."""
