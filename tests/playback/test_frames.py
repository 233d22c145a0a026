"""What is played is what the plan says: times, configurations, what is held, and every state on the way."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from llm3.playback import evenly, frames
from llm3.playback.frames import STANDSTILL
from llm3.types import (
    PACE,
    Action,
    Event,
    EventKind,
    Held,
    Moment,
    Motion,
    PlannedAction,
    Pose,
    Segment,
    State,
    Trajectory,
    moment_of,
)

GRASP, HERE, THERE = Pose((0.0, 0.0, 0.1)), Pose((1.0, 0.0, 0.0)), Pose((2.0, 0.0, 0.0))
START = State({"cup": HERE, "pot": THERE}, (0.0, 0.0))
TAKEN = State({"pot": THERE}, (1.0, 0.5), Held("cup", GRASP))
PUT = State({"cup": Pose((3.0, 0.0, 0.0)), "pot": THERE}, (0.0, 0.5))
CLOSE = (Event(EventKind.GRIPPER, opening=0.02), Event(EventKind.ATTACH, object="cup", grasp=GRASP))
OPEN = (Event(EventKind.DETACH, object="cup"), Event(EventKind.GRIPPER, opening=0.08))
TAKE = PlannedAction(
    Action("take"),
    Motion((Segment("approach", ((0.0, 0.0), (1.0, 0.0))), Segment("lift", ((1.0, 0.0), (1.0, 0.5)), CLOSE))),
    TAKEN,
)
PLACE = PlannedAction(
    Action("put"),
    Motion((Segment("transit", ((1.0, 0.5), (0.0, 0.5))), Segment("retreat", ((0.0, 0.5),), OPEN))),
    PUT,
)
RING = PlannedAction(Action("ring"), Motion(), PUT)
PLAN = (TAKE, PLACE, RING)
rates = st.floats(1, 200)


def moments(rate=10.0):
    return [frame.moment for frame in frames(START, PLAN, rate)]


@given(rates)
def test_time_goes_on_and_no_joint_is_faster_than_the_pace(rate):
    told = moments(rate)
    assert told[0] == moment_of(START)
    for one, other in pairwise(told):
        way = np.abs(np.subtract(other.configuration, one.configuration)).max()
        assert other.time >= one.time
        assert way <= PACE * (other.time - one.time) + 1e-9


@given(rates)
def test_every_action_ends_in_its_state(rate):
    last = {frame.action: frame.moment for frame in frames(START, PLAN, rate)}
    assert {index: moment.state for index, moment in last.items()} == {0: TAKEN, 1: PUT, 2: PUT}


def test_what_is_taken_moves_with_the_hand_until_it_is_let_go():
    told = [(moment.label, moment.held and moment.held.object, "cup" in moment.poses) for moment in moments()]
    assert list(dict.fromkeys(told)) == [
        ("", None, True),
        ("approach", None, True),
        ("lift", None, True),  # the fingers close
        ("lift", "cup", False),
        ("", "cup", False),
        ("transit", "cup", False),
        ("retreat", None, True),
    ]


def test_the_fingers_are_where_the_last_event_left_them():
    assert list(dict.fromkeys(moment.opening for moment in moments())) == [None, 0.02, 0.08]


def test_the_times_of_a_plan_without_times():
    _, first, *_, last = moments(10.0)
    assert first == Moment((0.1, 0.0), START.poses, time=0.1, label="approach")
    assert last.time == (1.0 + 0.5 + 1.0) / PACE + 4 * STANDSTILL


@given(rates)
def test_a_trajectory_is_followed(rate):
    trajectory = Trajectory((0.0, 2.0), ((0.0, 0.0), (1.0, 0.0)), ((0.0, 0.0), (0.0, 0.0)))
    step = PlannedAction(Action("go"), Motion((Segment("go", ((0.0, 0.0), (1.0, 0.0)), (), trajectory),)), START)
    _, *told, _ = (frame.moment for frame in frames(START, (step,), rate))
    assert told[-1].time == 2.0
    at = trajectory.sample([moment.time for moment in told])[0]
    assert np.allclose(at, [moment.configuration for moment in told])


@given(rates, st.floats(1, 60))
def test_a_film_has_a_frame_at_every_even_time(rate, per_second):
    told = list(frames(START, PLAN, rate))
    film = list(evenly(told, per_second))
    assert film[-1] == told[-1]
    assert len(film) > told[-1].moment.time * per_second
    for number, frame in enumerate(film[:-1]):
        assert frame.moment.time <= number / per_second
        following = told[told.index(frame) + 1 :]
        assert not any(frame.moment.time < other.moment.time <= number / per_second for other in following)


def test_of_an_empty_plan_the_start_is_shown():
    (frame,) = frames(START, (), 10.0)
    assert frame.moment == moment_of(START)
    assert list(evenly([frame], 10.0)) == [frame]
    assert list(evenly((), 10.0)) == []
