"""The search: what it finds, when it gives up, and that it is a solver like the other."""

from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from line_world import FINISH, Detour, Gamble, Line, TickingClock, go, play, reply, take

from llm3 import Budget, Env, search
from llm3.errors import PluginError, UsageError
from llm3.search import ATTEMPTS, MOTION_CALLS, Limits
from llm3.types import (
    ActionSchema,
    ActionTried,
    AttemptEnded,
    Failure,
    FailureKind,
    Goal,
    GoalStatus,
    MotionProblem,
    NoMotion,
    Parameter,
    ReplyRead,
    RunEnded,
    RunStarted,
    State,
    Transition,
)

AT_THE_FINISH = {("go", (), "x"): (FINISH, FINISH)}
ROOMS = 5
SEEDS = st.integers(0, 2**32)


def searched(env=None, **arguments):
    """Search in a world, with a clock that ticks alike for all."""
    return search(env or Line(), **{"planner": Detour(), "clock": TickingClock(), **arguments})


def untimed(result):
    return replace(result, stats=replace(result.stats, seconds={}))


class Maze(Env):
    """Rooms with doors that lead one way: from room 0 to where nothing of the goal is missing."""

    task = "Find the way out."
    schemas = (ActionSchema("enter", ("room",)),)
    objects = tuple(f"room{number}" for number in range(ROOMS))

    def __init__(self, doors, missing, moves=False):
        self.doors, self.missing, self.moves = doors, missing, moves

    def reset(self):
        return State(configuration=(0.0,), facts={"room": 0})

    def describe(self, state):
        return ()

    def prepare(self, state, action, rng):
        room = self.objects.index(action.objects[0])
        if (state.facts["room"], room) not in self.doors:
            return Failure(FailureKind.PRECONDITION, "there is no door")
        if not self.moves:
            return NoMotion()
        everywhere = lambda Q: Q[:, 0] > -1.0  # noqa: E731  # it is a value here
        return MotionProblem(state.configuration, (Goal((float(room),)),), 0.0, 10.0, everywhere, 0.1)

    def apply(self, state, action, motion):
        room = self.objects.index(action.objects[0])
        return Transition(State(configuration=(float(room),), facts={"room": room}))

    def goal(self, state):
        missing = self.missing[state.facts["room"]]
        return GoalStatus(missing == 0, tuple(f"thing {number} is missing" for number in range(missing)))


MAZES = st.builds(
    Maze,
    st.frozensets(st.tuples(st.integers(0, ROOMS - 1), st.integers(0, ROOMS - 1))),
    st.lists(st.integers(0, 3), min_size=ROOMS, max_size=ROOMS),
    st.booleans(),
)


def has_way_out(maze):
    reached, rooms = {0}, [0]
    while rooms:
        here = rooms.pop()
        found = {there for start, there in maze.doors if start == here} - reached
        reached |= found
        rooms += found
    return any(maze.missing[room] == 0 for room in reached)


# ---- what it finds -------------------------------------------------------------------------------------------------


@settings(max_examples=150)
@given(maze=MAZES, seed=SEEDS)
def test_a_finite_problem_is_solved_if_there_is_a_way_and_searched_through_if_there_is_none(maze, seed):
    result = searched(maze, seed=seed)
    assert result.stop == ("solved" if has_way_out(maze) else "exhausted")
    rooms = [0, *(step.state.facts["room"] for step in result.plan)]
    assert set(pairwise(rooms)) <= maze.doors
    assert maze.missing[rooms[-1]] == 0 or not result.solved


@pytest.mark.parametrize("sequel", [3, 2], ids=["through a setback", "over a plateau"])
def test_a_way_that_gets_worse_before_it_gets_better_is_found(sequel):
    maze = Maze({(0, 1), (1, 2), (2, 3), (3, 4)}, [2, sequel, sequel, sequel, 0])
    assert [step.state.facts["room"] for step in searched(maze).plan] == [1, 2, 3, 4]


def test_where_the_goal_is_reached_already_nothing_is_done():
    result = searched(Line(start=FINISH), budget=Budget(max_motion_calls=1))
    assert (result.solved, result.plan, result.stats.motion_calls, len(result.attempts)) == (True, (), 0, 1)


def test_an_action_whose_path_was_not_found_is_tried_again():
    result = searched(planner=Detour(no_path={FINISH: 3}), regions=AT_THE_FINISH)
    assert result.solved
    assert result.stats.motion_calls == 4


def test_and_a_problem_with_such_an_action_is_never_searched_through():
    maze = Maze({(0, 1)}, [1, 0, 1, 1, 1], moves=True)
    result = searched(maze, planner=Detour(no_path={1.0: 10**6}), budget=Budget(max_motion_calls=30))
    assert (result.stop, result.stats.motion_calls) == ("motions", 30)


@given(seed=SEEDS)
def test_parameters_are_drawn_from_the_domains_regions_or_else_from_the_schemas_ranges(seed):
    low, high = 3.33333, 3.44444
    narrow = searched(regions={("go", (), "x"): (low, high)}, seed=seed, budget=Budget(max_motion_calls=10))
    wide = searched(seed=seed, budget=Budget(max_motion_calls=10))
    drawn = {a.params["x"] for t in narrow.attempts for a in t.proposal.actions if a.name == "go"}
    assert all(low <= x <= high for x in drawn)
    drawn = {a.params["x"] for t in wide.attempts for a in t.proposal.actions if a.name == "go"}
    assert all(0 <= x <= 10 for x in drawn)
    assert max(drawn) - min(drawn) > high - low


# ---- that it is a solver like the other ----------------------------------------------------------------------------


@given(maze=MAZES, seed=SEEDS)
def test_a_model_that_proposes_its_plan_solves_the_problem_at_once_and_alike(maze, seed):
    result = searched(maze, seed=seed, planner=Gamble())
    if result.solved and maze.missing[0]:
        again = play(reply(*(step.action for step in result.plan)), env=maze, planner=Detour(), seed=seed)
        assert [(step.action, step.state) for step in again.plan] == [(step.action, step.state) for step in result.plan]


@given(seed=SEEDS)
def test_the_same_seed_gives_the_same_run(seed):
    runs = []
    for _ in range(2):
        events = []
        searched(planner=Gamble(), seed=seed, observer=events.append, budget=Budget(max_motion_calls=20))
        runs.append(events)
    assert runs[0] == runs[1]
    other = searched(planner=Gamble(), seed=seed + 1, budget=Budget(max_motion_calls=20))
    assert untimed(other) != untimed(runs[0][-1].result)


@given(seed=SEEDS)
def test_each_attempt_evaluates_one_action_and_the_others_are_known(seed):
    result = searched(planner=Gamble(), seed=seed, budget=Budget(max_motion_calls=20))
    outcomes = [attempt.outcomes for attempt in result.attempts]
    assert all(outcome.reused for tried in outcomes for outcome in tried[:-1])
    assert result.stats.reused_actions == sum(outcome.reused for tried in outcomes for outcome in tried)
    assert [attempt.number for attempt in result.attempts] == list(range(1, len(outcomes) + 1))


def test_the_observer_is_told_of_plans_actions_and_attempts_but_of_no_model():
    events = []
    result = searched(regions=AT_THE_FINISH, observer=events.append)
    assert isinstance(events[0], RunStarted)
    assert {type(event) for event in events[1:-1]} == {ReplyRead, ActionTried, AttemptEnded}
    assert events[-1] == RunEnded(result)
    assert [event.attempt for event in events if isinstance(event, AttemptEnded)] == list(result.attempts)
    assert all(event.feedback is None for event in events if isinstance(event, AttemptEnded))
    assert result.stats.llm_calls == 0


def test_a_mistake_of_the_world_is_told_as_its_own():
    class Broken(Line):
        def goal(self, state):
            return 7

    with pytest.raises(PluginError) as caught:
        searched(Broken())
    assert str(caught.value) == "Broken.goal must answer GoalStatus, not int."


# ---- when it gives up ----------------------------------------------------------------------------------------------


@given(limit=st.integers(1, 60), seed=SEEDS)
def test_no_more_motion_calls_are_made_than_allowed(limit, seed):
    result = searched(seed=seed, budget=Budget(max_motion_calls=limit))
    assert result.stats.motion_calls <= limit
    if not result.solved:  # a sample may hit the finish by chance
        assert (result.stop, result.stats.motion_calls, result.plan) == ("motions", limit, ())
        assert result.goal.unmet == ("the robot is not at the finish",)


def test_time_is_a_limit_as_well():
    assert searched(budget=Budget(max_seconds=500)).stop == "seconds"


def test_without_a_limit_that_it_can_reach_it_does_not_begin():
    with pytest.raises(UsageError) as caught:
        searched(budget=Budget(max_llm_calls=3, max_tokens=5))
    assert str(caught.value) == "a search needs a limit: max_motion_calls, max_seconds, or both."
    assert searched().stats.motion_calls == MOTION_CALLS


class Locked(Line):
    """Where nothing can be done, whatever the parameters."""

    schemas = (ActionSchema("go", (), (Parameter("x", 0, 10, "m"),)),)

    def prepare(self, state, action, rng):
        return Failure(FailureKind.PRECONDITION, "the wheel is locked")


def test_a_world_in_which_nothing_moves_ends_it_after_many_attempts():
    result = searched(Locked(), budget=Budget(max_motion_calls=7))
    assert (result.stop, result.stats.motion_calls, len(result.attempts)) == ("attempts", 0, 7 * ATTEMPTS)


def test_actions_that_fail_for_a_precondition_cost_no_motion_call():
    result = searched(budget=Budget(max_motion_calls=10))
    failed = [t.outcomes[-1] for t in result.attempts if t.outcomes and t.outcomes[-1].action == take("coin")]
    assert failed
    assert sum(t.failure is None and bool(t.outcomes) and not t.outcomes[-1].reused for t in result.attempts) == 10


def test_probes_are_as_wide_as_the_universal_restart_sequence_has_them():
    assert [2 ** Limits.of(probe).level for probe in range(1, 16)] == [1, 1, 2, 1, 1, 2, 4, 1, 1, 2, 1, 1, 2, 4, 8]
    grow = [Limits(level) for level in range(5)]
    for limit in ("width", "plateau", "setback", "share"):
        values = [getattr(limits, limit) for limits in grow]
        assert values == sorted(set(values))


def test_the_record_of_an_action_that_was_reused_tells_where_it_leads():
    events = []
    searched(regions={("go", (), "x"): (1.0, 1.0)}, observer=events.append, budget=Budget(max_motion_calls=3))
    coin = [event for event in events if isinstance(event, ActionTried) and event.outcome.action == take("coin")]
    assert any(event.step and not event.outcome.moved for event in coin)
    assert any(event.before.configuration == (1.0,) for event in coin)
    assert go(1.0) in {event.outcome.action for event in events if isinstance(event, ActionTried)}
