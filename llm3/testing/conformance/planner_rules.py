"""Rules for how a motion planner goes about its work."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.planning import Planning
from llm3.testing.conformance.purity_rules import global_generators
from llm3.types import Failure, FailureKind, Path


def every_query_ends(planning: Planning) -> Iterator[Fault]:
    """A query ends, by its budget of iterations if by nothing else."""
    planning.answers()
    if planning.error:
        raise planning.error  # it is told as what it is, and once
    if planning.endless:
        cause = "Count iterations, and answer NO_PATH when PlannerSettings.max_iterations are spent."
        yield Fault(planning.endless, cause)


def what_cannot_be_is_refused(planning: Planning) -> Iterator[Fault]:
    """An impossible query fails in the right way, and a possible one does not end at a goal that is in collision."""
    for answer in planning.answers():
        case, found = answer.case, answer.found
        kind = found.kind if isinstance(found, Failure) else None
        if case.failure and kind is not case.failure and isinstance(found, Path | Failure):
            said = kind.value if kind else "a path"
            yield Fault(
                f"{case.name}: the planner answers {said!r}, and not {case.failure.value!r}.",
                f"Test the start, then the goals, before a search; FreeSpace.free_goals does. ({case.failure.name})",
            )
        elif not case.failure and kind is not None and kind is not FailureKind.NO_PATH:
            yield Fault(
                f"{case.name}: the planner answers {kind.value!r}, and start and a goal are free.",
                "A goal in collision matters only if all are.",
            )
        if case.blamed and isinstance(found, Failure) and kind is case.failure and case.blamed not in found.objects:
            yield Fault(
                f"{case.name}: the failure blames {found.objects}, and {case.blamed!r} is in the way.",
                "Fill Failure.objects from problem.explain, so that a model hears of them; FreeSpace.collision does.",
            )


def easy_paths_are_found(planning: Planning) -> Iterator[Fault]:
    """A path is found where the straight line is free."""
    for answer in planning.answers():
        if answer.case.straight and isinstance(answer.found, Failure):
            yield Fault(
                f"{answer.case.name}: no path is found, but {answer.found.kind.value!r}.",
                "The straight line is free: try it first. Limits are inclusive, and a start may be a goal.",
            )


def other_limits_are_no_obstacle(planning: Planning) -> Iterator[Fault]:
    """A path that is found is found in other joint limits, too, to which all of the world is scaled."""
    found = {answer.case.name: answer.found for answer in planning.answers()}
    for answer in planning.answers():
        case = answer.case
        if isinstance(found.get(case.like), Path) and isinstance(answer.found, Failure):
            yield Fault(
                f"{case.name}: no path is found, and one is found in the world {case.like!r}, which is the same.",
                "Draw samples between problem.low and problem.high, and measure steps by problem.resolution.",
            )


def what_is_blamed_was_touched(planning: Planning) -> Iterator[Fault]:
    """A failure blames only what explain told to be touched."""
    for case, found, questions in planning.told():
        for name in found.objects if isinstance(found, Failure) else ():
            if name not in questions.blamed:
                yield Fault(
                    f"{case.name}: the failure blames {name!r}, and nothing that was asked about touches it.",
                    "Blame the objects of the contacts that problem.explain answers in this query, or nothing.",
                )
                return


def the_same_generator_gives_the_same_path(planning: Planning) -> Iterator[Fault]:
    """The same problem and generator state give the same answer, whatever was planned in between."""
    for answer in planning.answers():
        again = planning.asked(answer.case)
        if again is None or not _same(answer.found, again.found):
            yield Fault(
                f"{answer.case.name}: the same generator gives two answers.",
                "Draw from the rng that plan is given and from nothing else, count iterations and not seconds, and "
                "keep nothing between queries.",
            )
            return


def chance_is_the_generator_that_is_given(planning: Planning) -> Iterator[Fault]:
    """No query draws from the generators that everybody shares."""
    before = global_generators()
    for answer in planning.answers():
        planning.asked(answer.case)
    if global_generators() != before:
        yield Fault(
            "a query draws from the global generator of random or numpy.", "Draw from the rng that plan is given."
        )


def problems_are_left_alone(planning: Planning) -> Iterator[Fault]:
    """A query changes neither start, goals nor limits."""
    for answer in planning.answers():
        if not answer.left_alone:
            yield Fault(f"{answer.case.name}: a query changes its problem.", "Copy problem.start before working on it.")
            return


def _same(one: Path | Failure, other: Path | Failure) -> bool:
    if isinstance(one, Path) and isinstance(other, Path):
        return one.goal_index == other.goal_index and np.array_equal(one.waypoints, other.waypoints)
    return one == other


RULES = (
    every_query_ends,
    what_cannot_be_is_refused,
    easy_paths_are_found,
    other_limits_are_no_obstacle,
    what_is_blamed_was_touched,
    the_same_generator_gives_the_same_path,
    chance_is_the_generator_that_is_given,
    problems_are_left_alone,
)
