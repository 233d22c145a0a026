"""Actions, and their motions and outcomes, as values."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.types import (
    Action,
    Attempt,
    Contact,
    Event,
    EventKind,
    Failure,
    FailureKind,
    Goal,
    GoalStatus,
    Motion,
    MotionProblem,
    Outcome,
    Path,
    Proposal,
    Rejected,
    Segment,
    Sketch,
    Stats,
)

names = st.text(st.characters(categories=["Ll"]), min_size=1, max_size=6)
params = st.dictionaries(names, st.floats(allow_nan=False, allow_infinity=False), max_size=4)
UNMET = GoalStatus(False, ("something is missing",))


def problem(**changes):
    arguments = {
        "start": (0, 0),
        "goals": (Goal((1, 1)),),
        "low": 0,
        "high": (2, 3),
        "valid": lambda Q: np.ones(len(Q), dtype=bool),
        "resolution": 0.1,
    }
    return MotionProblem(**{**arguments, **changes})


# ---- actions -------------------------------------------------------------------------------------------------------


@given(names, st.lists(names, max_size=3), params)
def test_equal_actions_hash_alike_however_they_were_given(name, objects, values):
    action = Action(name, tuple(objects), values)
    other = Action(name, objects, dict(reversed(values.items())))
    assert other == action
    assert hash(other) == hash(action)


@given(names, params)
def test_parameters_are_floats_in_the_order_given(name, values):
    action = Action(name, (), values)
    assert list(action.params.items()) == list(values.items())
    assert all(type(value) is float for value in Action(name, (), {"n": 3}).params.values())


def test_an_action_reads_as_a_model_writes_it():
    assert str(Action("place", ("red_box",), {"x": 0.5, "y": 0})) == "place(['red_box'], {'x': 0.5, 'y': 0.0})"
    assert str(Action("wait")) == "wait([], {})"
    assert str(Action("stack", ("a", "b"))) == "stack(['a', 'b'], {})"
    assert str(Sketch("place", ("red_box",))) == "place(['red_box'], ...)"
    assert str(Rejected("dance()", Failure(FailureKind.INVALID_ACTION))) == "dance()"


def test_an_action_does_not_change_with_what_it_was_made_from():
    values, objects = {"x": 1.0}, ["box"]
    action = Action("place", objects, values)
    values["x"] = 2.0
    objects.append("lid")
    assert action == Action("place", ("box",), {"x": 1.0})
    with pytest.raises(TypeError):
        action.params["x"] = 3.0


# ---- failures and attempts -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", FailureKind)
def test_motion_was_evaluated_for_just_the_failures_of_motion(kind):
    of_motion = {"unreachable", "goal in collision", "start in collision", "no path within budget"}
    assert kind.is_motion == (kind.value in of_motion)


@pytest.mark.parametrize("kind", FailureKind)
def test_only_no_path_may_turn_out_otherwise_with_another_seed(kind):
    assert kind.is_final == (kind is not FailureKind.NO_PATH)


def test_what_a_failure_cost_is_no_part_of_what_it_is():
    cheap = Failure(FailureKind.UNREACHABLE, objects=("box",), measures={"error": 0.1})
    dear = Failure(FailureKind.UNREACHABLE, objects=("box",), measures={"error": 0.1}, stats=Stats(ik_calls=9))
    assert cheap == dear
    assert hash(cheap) == hash(dear)
    assert cheap != Failure(FailureKind.UNREACHABLE, objects=("box",), contacts=(Contact("arm", "box"),))


def test_what_ended_an_attempt():
    no_reply = Failure(FailureKind.UNREADABLE_REPLY)
    blocked = Failure(FailureKind.GOAL_IN_COLLISION)
    fine, stuck = Outcome(Action("wait")), Outcome(Action("go"), blocked)
    assert Attempt(1, UNMET, unreadable=no_reply).failure is no_reply
    assert Attempt(1, UNMET, Proposal(()), outcomes=(fine, stuck)).failure is blocked
    assert Attempt(1, UNMET, Proposal(()), outcomes=(fine,)).failure is None
    assert Attempt(1, UNMET, Proposal(())).failure is None


# ---- motions -------------------------------------------------------------------------------------------------------


def test_one_limit_stands_for_every_joint():
    made = problem()
    assert made.start.tolist() == [0.0, 0.0]
    assert made.low.tolist() == [0.0, 0.0]
    assert made.high.tolist() == [2.0, 3.0]
    assert made.resolution.tolist() == [0.1, 0.1]
    assert made.explain(made.start) == ()


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"start": 1.0}, "start must be one configuration of shape (dof,), not ()"),
        ({"start": [[0, 0]]}, "start must be one configuration of shape (dof,), not (1, 2)"),
        ({"goals": ()}, "a motion problem needs at least one goal"),
        ({"goals": (Goal((1, 1)), Goal((1,)))}, "a goal has 1 joint values, the start 2"),
    ],
)
def test_a_problem_without_sense_is_refused(changes, sentence):
    with pytest.raises(ValueError) as caught:
        problem(**changes)
    assert str(caught.value) == sentence


def test_the_motion_of_an_action_is_the_path_and_the_pieces_of_the_goal_it_reached():
    opened, closed = Event(EventKind.GRIPPER, opening=0.08), Event(EventKind.ATTACH, object="box")
    lift = Segment("lift", ((1.0, 1.0), (1.0, 2.0)), (closed,))
    asked = problem(goals=(Goal((0, 1)), Goal((1, 1), (lift,))), label="approach", before=(opened,))
    motion = asked.motion(Path(np.array([[0, 0], [1, 1]]), goal_index=1))
    assert motion == Motion((Segment("approach", ((0.0, 0.0), (1.0, 1.0)), (opened,)), lift))
    assert motion.end == (1.0, 2.0)
    assert motion.events == (opened, closed)
    assert Motion().events == ()


def test_a_path_is_as_long_as_its_pieces():
    assert Path(np.array([[0, 0], [3, 4], [3, 5]])).length == pytest.approx(6.0)
    assert Path(np.array([[0, 0]])).length == 0.0
    assert math.isclose(Path(np.array([[0.0], [-2.0]])).length, 2.0)


def test_equal_actions_are_written_alike_also_at_zero():
    assert str(Action("go", (), {"x": -0.0})) == str(Action("go", (), {"x": 0.0})) == "go([], {'x': 0.0})"
