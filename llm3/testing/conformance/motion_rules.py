"""Rules for the motion problems that prepare answers."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.samples import malformed, samples, some_goals
from llm3.testing.conformance.values import configuration
from llm3.testing.conformance.world import World
from llm3.types import Contact, Goal, MotionProblem

COARSE = 10
"""A resolution coarser than this fraction of a joint's range steps over most obstacles."""
LONGEST = 200
"""Samples of the longest line that is looked at."""
NO_EXPLANATION = MotionProblem.__dataclass_fields__["explain"].default


def a_motion_begins_where_the_robot_is(world: World) -> Iterator[Fault]:
    """The start of a motion problem is the configuration of the state."""
    for trial, problem in world.queries:
        here = trial.state.configuration
        if len(here) != len(problem.start) or not np.allclose(problem.start, here, rtol=0, atol=1e-9):
            yield Fault(
                f"{trial} starts at {configuration(problem.start)}, and the robot is at {configuration(here)}.",
                "The start is state.configuration, and no field of the Env.",
            )


def limits_hold_what_follows_a_goal(world: World) -> Iterator[Fault]:
    """Limits are finite, low is below high, and what follows a goal lies between, as start and goals do."""
    for trial, problem in world.queries:
        low, high = problem.low, problem.high
        if not (np.isfinite(low).all() and np.isfinite(high).all() and (low <= high).all()):
            text = f"the limits of {trial} are {configuration(low)} to {configuration(high)}."
            yield Fault(text, "A joint that turns without end needs finite limits, too, such as -2π and 2π.")
            continue
        for segment in (segment for goal in some_goals(problem) for segment in goal.then):
            for q in map(np.array, segment.waypoints):
                if q.shape == low.shape and ((q < low - 1e-6) | (q > high + 1e-6)).any():
                    yield Fault(
                        f"the piece {segment.label!r} of {trial} goes to {configuration(q)}, outside of "
                        f"{configuration(low)} to {configuration(high)}.",
                        "Refuse such a goal as UNREACHABLE, or widen the limits: no joint leaves them.",
                    )


def the_resolution_is_fine(world: World) -> Iterator[Fault]:
    """The resolution is positive, and finer than a tenth of each joint's range."""
    for trial, problem in world.queries:
        span = problem.high - problem.low
        if not (problem.resolution > 0).all() or (COARSE * problem.resolution > span)[span > 0].any():
            yield Fault(
                f"the resolution of {trial} is {configuration(problem.resolution)} in ranges of {configuration(span)}.",
                "It is how far apart two samples of a straight line may be: positive, and finer than the obstacles.",
            )


def validity_is_one_answer_a_configuration(world: World) -> Iterator[Fault]:
    """The test takes (N, dof) and answers (N,), the same one by one and again, and leaves what it is given alone."""
    for trial, problem in world.malformed:
        yield Fault(
            f"the validity test of {trial} answers {malformed(problem)}.",
            "It takes one configuration a row, and answers a numpy array of bool, one for each row.",
        )
        return
    for trial, problem in world.queries:
        at = samples(problem)
        given = at.copy()
        mask = problem.valid(at)
        if not np.array_equal(at, given):
            yield Fault(f"the validity test of {trial} changes the configurations that it is given.", "Work on a copy.")
        if not np.array_equal(mask, problem.valid(given.copy())):
            yield Fault(f"the validity test of {trial} does not answer the same twice.", "It must not draw or count.")
        alone = np.array([problem.valid(q[None])[0] for q in given])
        if not np.array_equal(mask, alone):
            q = given[np.flatnonzero(mask != alone)[0]]
            yield Fault(
                f"the validity test of {trial} answers {configuration(q)} differently alone and among others.",
                "A reduction over the wrong axis: all(axis=1) is one answer a row, all() is one for all rows.",
            )


def the_robot_can_leave_its_start(world: World) -> Iterator[Fault]:
    """The initial configuration is free."""
    for trial, problem in world.queries:
        if trial.state == world.start and not np.asarray(problem.valid(problem.start[None])).all():
            yield Fault(
                f"the robot stands at {configuration(problem.start)} in collision, says the validity test of {trial}.",
                "No planner starts there: move the start, or lower the distance that is kept.",
            )


def what_is_not_free_is_explained(world: World) -> Iterator[Fault]:
    """What is in collision has a name: explain gives one where valid says no, and none where it says yes."""
    for trial, problem in world.queries:
        if problem.explain is NO_EXPLANATION:
            continue
        at = samples(problem)
        for q, free in zip(at, np.asarray(problem.valid(at)), strict=True):
            contacts = problem.explain(q)
            if not isinstance(contacts, tuple) or not all(isinstance(contact, Contact) for contact in contacts):
                yield Fault(
                    f"explain of {trial} must answer a tuple of Contact, not {contacts!r}.",
                    "A tuple of one needs a comma.",
                )
                return
            if free and contacts:
                yield Fault(
                    f"explain of {trial} finds {contacts[0].object} at {configuration(q)}, which is free by valid.",
                    "The two must keep the same distance from the same things.",
                )
            if not free and not contacts:
                yield Fault(
                    f"explain of {trial} finds nothing at {configuration(q)}, which is not free by valid.",
                    "The two must look at the same things: the model hears of what explain names, and of no other.",
                )


def what_is_uncertain_holds_all_that_is_not_free(world: World) -> Iterator[Fault]:
    """Where uncertain leaves a sample out, valid says that it is free."""
    for trial, problem in world.queries:
        if problem.uncertain is None:
            continue
        at = samples(problem, 4)
        for start, far in pairwise(at):
            steps = max(1, int(np.ceil((np.abs(far - start) / problem.resolution).sum())))
            end = start + (far - start) * min(1.0, LONGEST / steps)
            steps = min(steps, LONGEST)
            need = np.asarray(problem.uncertain(start, end, steps))
            if need.shape != (steps + 1,):
                text = f"uncertain of {trial} answers {steps} steps with shape {need.shape}."
                yield Fault(text, "It answers one truth value for each of steps + 1 samples.")
                return
            line = start + np.linspace(0, 1, steps + 1)[:, None] * (end - start)
            left_out = ~need.astype(bool)
            wrong = left_out & ~np.asarray(problem.valid(line)).astype(bool)
            if wrong.any():
                yield Fault(
                    f"uncertain of {trial} leaves out {configuration(line[np.flatnonzero(wrong)[0]])}, "
                    "which is not free.",
                    "It may leave out only what is certainly free, the distance that is kept included.",
                )
                return


def goals_lead_on_without_a_jump(world: World) -> Iterator[Fault]:
    """What follows a goal begins in its configuration, and each piece where the last one ended."""
    for trial, problem in world.queries:
        for goal in some_goals(problem):
            if not isinstance(goal, Goal):
                yield Fault(f"a goal of {trial} is {goal!r}.", "Goals are llm3.types.Goal, each with a configuration.")
                return
            here = np.array(goal.configuration)
            for segment in goal.then:
                way = np.array(segment.waypoints, dtype=float)
                if (
                    not segment.label.strip()
                    or way.ndim != 2
                    or way.shape[1] != len(here)
                    or not np.isfinite(way).all()
                ):
                    yield Fault(
                        f"the piece {segment.label!r} after a goal of {trial} has waypoints of shape {way.shape}.",
                        "A Segment has a label, and one or more finite waypoints with a value for each joint.",
                    )
                    return
                if not np.allclose(way[0], here, rtol=0, atol=1e-6):
                    yield Fault(
                        f"the piece {segment.label!r} after a goal of {trial} begins at {configuration(way[0])}, "
                        f"and the robot is at {configuration(here)}.",
                        "The pieces of Goal.then begin with the goal's configuration, and follow one another.",
                    )
                here = way[-1]


RULES = (
    a_motion_begins_where_the_robot_is,
    limits_hold_what_follows_a_goal,
    the_resolution_is_fine,
    validity_is_one_answer_a_configuration,
    the_robot_can_leave_its_start,
    what_is_not_free_is_explained,
    what_is_uncertain_holds_all_that_is_not_free,
    goals_lead_on_without_a_jump,
)
