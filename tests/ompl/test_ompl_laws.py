"""What holds of every planner and every path, in worlds of random discs."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from disc_worlds import NAMES, RESOLUTION, among_discs, barrier, inflated_by, plan, sampled
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from llm3.types import Failure, FailureKind, Goal, Mask, MotionProblem, Path, Vector

QUICK = settings(deadline=None, max_examples=40)

coordinates = st.floats(0.0, 1.0).map(lambda x: round(x, 3))
points = st.tuples(coordinates, coordinates)
disc_lists = st.lists(st.tuples(coordinates, coordinates, st.floats(0.02, 0.25)), max_size=6)
left, right = (points.map(lambda p, side=side: (round(side + 0.38 * p[0], 3), p[1])) for side in (0.0, 0.62))
anywhere = st.tuples(points, st.lists(points, min_size=1, max_size=4), disc_lists)
across = st.tuples(left, st.lists(right, min_size=1, max_size=4), st.builds(barrier, st.integers(0, 6)))
worlds = st.one_of(across, anywhere)  # a start, goals and discs; across a barrier most ways need a search
problems = worlds.map(lambda world: among_discs(*world))
names, seeds = st.sampled_from(NAMES), st.integers(0, 9)


@given(names, worlds, seeds)
@QUICK
def test_a_path_joins_the_start_and_the_goal_that_it_names(name, world, seed) -> None:
    start, goals, _ = world
    path = plan(name, among_discs(*world), seed)
    assume(isinstance(path, Path))
    assert tuple(path.waypoints[0]) == start
    assert tuple(path.waypoints[-1]) == goals[path.goal_index]


@given(names, problems, seeds)
@QUICK
def test_a_path_stays_within_the_limits_and_is_valid_at_the_resolution(name, problem, seed) -> None:
    path = plan(name, problem, seed)
    assume(isinstance(path, Path))
    assert (path.waypoints >= problem.low).all()
    assert (path.waypoints <= problem.high).all()
    assert problem.valid(sampled(path, RESOLUTION)).all()


@given(names, worlds, seeds)
@QUICK
def test_a_margin_of_the_resolution_makes_up_for_what_lies_between_samples(name, world, seed) -> None:
    path = plan(name, among_discs(*world), seed)
    assume(isinstance(path, Path))
    discs = world[2]
    assert inflated_by(0.0, discs)(sampled(path, RESOLUTION / 4)).all()


@given(names, problems, seeds)
@QUICK
def test_the_same_generator_state_gives_the_same_answer(name, problem, seed) -> None:
    first, _, second = plan(name, problem, seed), plan(name, problem, seed + 1), plan(name, problem, seed)
    assert type(first) is type(second)
    assert first.stats == second.stats
    if isinstance(first, Path) and isinstance(second, Path):
        assert np.array_equal(first.waypoints, second.waypoints)
        assert first.goal_index == second.goal_index
    else:
        assert first == second


@given(names, problems, seeds)
@QUICK
def test_what_was_spent_is_told(name, problem, seed) -> None:
    tested = []

    def counted(samples: Vector) -> Mask:
        tested.append(len(samples))
        return problem.valid(samples)

    stats = plan(name, dataclasses.replace(problem, valid=counted), seed, iterations=50).stats
    assert stats.planner_calls == 1
    assert stats.planner_iterations <= 50
    assert stats.validity_checks == sum(tested)
    assert stats.time_limited == 0


@given(names, worlds, st.randoms(use_true_random=False))
@QUICK
def test_the_order_of_the_goals_decides_nothing_but_the_preference(name, world, random) -> None:
    start, goals, discs = world
    shuffled = random.sample(goals, len(goals))
    kinds = [
        answer.kind if isinstance(answer, Failure) else "a straight way" if len(answer.waypoints) == 2 else "a path"
        for answer in (plan(name, among_discs(start, order, discs), iterations=0) for order in (goals, shuffled))
    ]
    assert kinds[0] == kinds[1]


@given(names, problems)
@QUICK
def test_failures_are_what_they_are_called(name, problem) -> None:
    goals = np.array([goal.configuration for goal in problem.goals])
    start_free, goals_free = problem.valid(problem.start[None])[0], problem.valid(goals)
    answer = plan(name, problem, iterations=20)
    if not start_free:
        assert isinstance(answer, Failure)
        assert answer.kind is FailureKind.START_IN_COLLISION
    elif not goals_free.any():
        assert isinstance(answer, Failure)
        assert answer.kind is FailureKind.GOAL_IN_COLLISION
    elif isinstance(answer, Failure):
        assert answer.kind is FailureKind.NO_PATH
        assert answer.measures == {"iterations": answer.stats.planner_iterations}
    else:
        assert goals_free[answer.goal_index]


@given(names, anywhere, st.booleans())
@QUICK
def test_a_collision_of_start_or_goals_costs_no_search(name, world, at_start) -> None:
    start, goals, discs = world
    in_the_way = [(x, y, 0.1) for x, y in ([start] if at_start else goals)]
    failure = plan(name, among_discs(start, goals, [*discs, *in_the_way]))
    assert isinstance(failure, Failure)
    assert failure.kind in (FailureKind.START_IN_COLLISION, FailureKind.GOAL_IN_COLLISION)
    assert set(failure.objects) >= {contact.object for contact in failure.contacts} != set()
    assert failure.stats.planner_iterations == 0
    assert failure.stats.validity_checks == 1 + len(goals)


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("name", NAMES)
def test_seven_joints_are_planned_as_two_are(name: str, seed: int) -> None:
    def valid(q: Vector) -> Mask:
        shell = np.abs(np.linalg.norm(q[:, :6], axis=1) - 2.0) < 0.2  # around the start ...
        return ~shell | (q[:, 6] > 1.5)  # ... which the last joint opens

    goal = (2.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    problem = MotionProblem(np.zeros(7), (Goal(goal),), np.full(7, -2.8), np.full(7, 2.8), valid, np.full(7, 0.05))
    path = plan(name, problem, seed, iterations=2000)
    assert isinstance(path, Path)
    assert len(path.waypoints) > 2
    assert tuple(path.waypoints[-1]) == goal
    assert valid(sampled(path, 0.05)).all()
