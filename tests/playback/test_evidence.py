"""What is to be seen of a failure is what the failure tells."""

from __future__ import annotations

from dataclasses import replace

import pytest

from llm3.playback import Touch, evidence, touching
from llm3.types import (
    ITSELF,
    Action,
    ActionTried,
    Contact,
    Event,
    EventKind,
    Failure,
    FailureKind,
    Held,
    Motion,
    Outcome,
    PlannedAction,
    Pose,
    Segment,
    State,
)

CUP, BOX = Pose((0.5, 0.0, 0.1)), Pose((0.2, 0.3, 0.1))
STANDING = State({"cup": CUP, "red box": BOX}, (0.1, 0.2))
HOLDING = State({"cup": CUP}, (0.1, 0.2), Held("red box", Pose((0, 0, 0))))
ROBOT = ("hand", "arm")
PLACE = Action("place", ("red box",))


def failed(*contacts, before=HOLDING, configuration=(1.0, 2.0)):
    failure = Failure(FailureKind.GOAL_IN_COLLISION, contacts=contacts, configuration=configuration)
    return ActionTried(1, 0, before, Outcome(PLACE, failure))


def after_gripper(opening):
    segment = Segment("transit", ((0.0, 0.0), (0.1, 0.2)), (Event(EventKind.GRIPPER, opening=opening),))
    return PlannedAction(Action("pick", ("red box",)), Motion((segment,)), HOLDING)


def test_what_can_be_done_is_no_evidence():
    done = replace(failed(), outcome=Outcome(PLACE))
    assert evidence(done, (), ROBOT) is None


def test_the_world_is_as_it_was_and_the_robot_where_it_failed():
    found = evidence(failed(), (), ROBOT)
    assert found.moment.poses == HOLDING.poses
    assert found.moment.held == HOLDING.held
    assert found.moment.configuration == (1.0, 2.0)


def test_where_no_configuration_is_told_the_robot_is_where_it_stood():
    assert evidence(failed(configuration=()), (), ROBOT).moment.configuration == HOLDING.configuration


def test_fingers_are_as_far_apart_as_what_they_hold_has_left_them():
    steps = [after_gripper(0.08), after_gripper(0.03)]
    assert evidence(failed(), steps, ROBOT).moment.opening == 0.03
    assert evidence(failed(before=STANDING), steps, ROBOT).moment.opening is None
    assert evidence(failed(), (), ROBOT).moment.opening is None


@pytest.mark.parametrize(
    ("contact", "movers", "other"),
    [
        (Contact("gripper", "cup", link="hand"), ("hand",), "cup"),
        (Contact("held red box", "cup"), ("red box",), "cup"),
        (Contact("pushed cup", "red box"), ("cup",), "red box"),
        (Contact("arm", "cup"), ("arm",), "cup"),
        (Contact("gripper", "cup"), ROBOT, "cup"),
        (Contact("gripper", ITSELF, link="hand", other_link="arm"), ("hand",), "arm"),
    ],
    ids=["a link", "what is held", "what is pushed", "a part", "the robot as a whole", "the robot itself"],
)
def test_what_touches_goes_by_the_names_of_bodies(contact, movers, other):
    found = evidence(failed(contact), (), ROBOT)
    assert found.touches == (Touch(movers, other, contact),)
    assert touching(found.touches) == {*movers, other}
