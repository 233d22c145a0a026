"""A plan is carried out by what its domain offers, and held against what it promised."""

from __future__ import annotations

import contextlib
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from llm3 import Domain, Env
from llm3.assembly import open_problem
from llm3.errors import InputError, MissingCapability, PluginError, UsageError
from llm3.execution import execute, open_executor
from llm3.interfaces import Executor, Joint
from llm3.records import PlanFile
from llm3.types import (
    Action,
    ActionSchema,
    Executed,
    Execution,
    GoalStatus,
    Motion,
    Noise,
    Parameter,
    PlannedAction,
    Pose,
    PoseError,
    Segment,
    State,
)

STILL = Pose((0.0, 0.0, 0.0))


class Pushed(Env):
    """A cup, and an arm that pushes it along x to 1 m."""

    task = "Push the cup to x = 1."
    schemas = (ActionSchema("push", ("thing",), (Parameter("x", 0, 2, "m"),), "push it to x"),)
    objects = ("cup",)
    joints = (Joint("slide", "m"),)

    def reset(self):
        return State({"cup": STILL}, (0.0,))

    def describe(self, state):
        raise NotImplementedError

    def prepare(self, state, action, rng):
        raise NotImplementedError

    def apply(self, state, action, motion):
        raise NotImplementedError

    def goal(self, state):
        there = abs(state.poses["cup"].position[0] - 1.0) < 0.01
        return GoalStatus(there, () if there else ("the cup is elsewhere",))


class Pusher(Executor):
    """Leaves the state that it was made with, or raises it."""

    def __init__(self, answer):
        self.answer, self.closed = answer, 0

    def execute(self, start, actions, rng):
        if isinstance(self.answer, Exception):
            raise self.answer
        if isinstance(self.answer, State):
            return Execution(start, self.answer, tuple(Executed(step.action, 1.0) for step in actions))
        return self.answer

    def close(self):
        self.closed += 1


class Pushing(Domain):
    name, description, settings, default_setting, instance_type = "pushing", "A cup.", ("one",), "one", dict
    pusher: object = None

    def instance(self, setting, seed):
        return {}

    def make(self, instance, options):
        return Pushed()

    def executor(self, instance, options, noise):
        if noise:
            raise UsageError("a robot has a noise of its own.")
        return self.pusher


def at(x: float, turn: float = 0.0) -> State:
    return State({"cup": Pose((x, 0.0, 0.0), (0.0, 0.0, np.sin(turn / 2), np.cos(turn / 2)))}, (x,))


def pushed(x: float, action: Action | None = None) -> PlannedAction:
    motion = Motion((Segment("push", ((0.0,), (x,))),))
    return PlannedAction(action or Action("push", ("cup",), {"x": x}), motion, at(x))


PLAN = PlanFile("llm3-plan/1", "pushing", {}, {}, Pushed.joints, Pushed().reset(), (pushed(1.0),))


def carried_out(pusher, plan=PLAN, noise=Noise()):  # noqa: B008  # frozen
    domain = Pushing()
    domain.pusher = pusher
    with open_problem(domain, {}, {}) as problem, open_executor(problem, noise) as executor:
        return execute(problem, plan, executor, np.random.default_rng(0))


def test_the_goal_is_asked_of_where_it_really_ends():
    assert carried_out(Pusher(at(1.0))).goal == GoalStatus(True)
    assert carried_out(Pusher(at(0.5))).goal == GoalStatus(False, ("the cup is elsewhere",))


@given(st.floats(-1.0, 1.0), st.floats(-3.1, 3.1), st.floats(-3.1, 3.1))
def test_the_error_of_a_pose_is_how_far_and_how_much_it_is_turned(x, one, other):
    plan = replace(PLAN, actions=(replace(pushed(1.0), state=at(1.0, one)),))
    error = carried_out(Pusher(at(x, other)), plan).pose_errors["cup"]
    turn = (Rotation.from_euler("z", one).inv() * Rotation.from_euler("z", other)).magnitude()
    assert error.position == pytest.approx(1.0 - x, abs=1e-4)
    assert error.angle == pytest.approx(turn, abs=1e-3)


def test_without_an_action_everything_should_be_where_it_was():
    assert carried_out(Pusher(at(0.2)), replace(PLAN, actions=())).pose_errors == {"cup": PoseError(0.2, 0.0)}


def test_the_executor_is_closed_whatever_happens():
    for answer in (at(1.0), ValueError("oops")):
        pusher = Pusher(answer)
        with contextlib.suppress(PluginError):
            carried_out(pusher)
        assert pusher.closed == 1


def test_a_domain_without_an_executor():
    with pytest.raises(MissingCapability) as caught:
        carried_out(None)
    assert str(caught.value) == "domain 'pushing' has no executor, which 'llm3 execute' needs."


def test_an_executor_may_refuse_noise():
    with pytest.raises(UsageError, match=r"^a robot has a noise of its own\.$"):
        carried_out(Pusher(at(1.0)), noise=Noise(joints=0.1))


@pytest.mark.parametrize(
    ("answer", "sentence"),
    [
        (ValueError("oops"), r"^Pusher\.execute raised ValueError: oops \(test_carrying_out\.py:\d+\)\.$"),
        ((), r"^Pusher\.execute must answer Execution, not tuple\.$"),
        (
            Execution(at(0.0), at(1.0), ()),
            r"^Pusher\.execute must tell of all 1 actions of the plan, not of 0\.$",
        ),
    ],
)
def test_an_executor_that_fails_is_named(answer, sentence):
    with pytest.raises(PluginError, match=sentence):
        carried_out(Pusher(answer))
    with pytest.raises(PluginError, match=r"^Pushing\.executor must answer Executor or NoneType, not int\.$"):
        carried_out(7)


def test_a_plan_that_starts_elsewhere_is_refused_before_anything_moves():
    with pytest.raises(InputError) as caught:
        carried_out(Pusher(AssertionError("it moved")), replace(PLAN, start=replace(PLAN.start, configuration=(0.5,))))
    assert str(caught.value) == "the plan does not start where the problem does: configuration is [0.5], not [0.0]."


def test_what_is_no_action_is_refused_before_anything_moves():
    moves = Pusher(AssertionError("it moved"))
    with pytest.raises(InputError) as caught:
        carried_out(moves, replace(PLAN, actions=(pushed(1.0), pushed(1.0, Action("fly", ("cup",))))))
    assert str(caught.value) == "action 2 fly(['cup'], {}): unknown action 'fly': the actions are push."
