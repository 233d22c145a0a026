"""The second opinion on motions: a sound plan has no defect, and whatever goes wrong on the way has its sentence."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from shelf_world import (
    CARRIED,
    CARRYING,
    DROP,
    END,
    LEAVE,
    LEAVING,
    SHELF,
    TAKE,
    at,
    found,
    lines,
    moved_by,
    verification,
)

from llm3.types import Action, Defect, FrozenDict, Motion, PlannedAction, Pose, Segment, State
from llm3_bullet.scene import Box


@pytest.fixture(scope="module")
def robot(descriptions):
    return descriptions["toy"]


def test_a_sound_plan_has_no_defect(robot):
    report = verification(robot)
    assert report.defects == ()
    assert report.sound
    assert report.configurations > 50
    assert report.deepest_contact < 1e-6
    assert report.clearances["carry"] == pytest.approx(0.0, abs=1e-6)  # the box slides along the shelf
    assert report.clearances["leave"] == pytest.approx(0.003, abs=1e-4)  # a finger passes the shelf, 2 mm closer now


def test_the_same_plan_has_the_same_report(robot):
    assert verification(robot) == verification(robot)


def test_a_defect_says_where_in_fields_too(robot):
    blocked = verification(
        robot, fixed=(SHELF, Box("post", (0.02, 0.02, 0.02), Pose((CARRIED + 0.025, 0.1, 1.09)), fixed=True))
    )
    touch = blocked.defects[0]
    assert (touch.number, touch.action, touch.segment, touch.time) == (1, "take([], {})", "carry", None)
    assert 0.0 < touch.waypoint <= 1.0
    assert touch.measures["depth"] > 0.001
    assert str(touch) == f"{CARRYING}, waypoint {touch.waypoint:.2f}: {touch.sentence}"
    assert not blocked.sound


def test_measures_are_frozen():
    assert isinstance(Defect("wrong", measures={"a": 1.0}).measures, FrozenDict)
    assert str(Defect("wrong")) == "wrong"


# ---- what goes wrong on the way --------------------------------------------------------------------------------------


def test_what_is_carried_into_something_touches_it(robot):
    fixed = (SHELF, Box("post", (0.02, 0.02, 0.02), Pose((CARRIED + 0.025, 0.1, 1.09)), fixed=True))
    assert lines(robot, fixed=fixed)[0] == f"{CARRYING}, waypoint 1.00: box touches post, 5.00 mm deep"


def test_a_thin_wall_is_not_passed_through(robot):
    fixed = (SHELF, Box("wall", (0.0001, 0.5, 0.3), Pose((-0.05, 0.0, 1.2)), fixed=True))
    way_round = replace(LEAVE, waypoints=(*LEAVE.waypoints, at(-0.1), at(END)))
    told = lines(robot, (TAKE, moved_by(DROP, way_round)), fixed=fixed)
    touching = {line.partition(": ")[2].partition(",")[0] for line in told}
    assert touching == {"left touches wall", "right touches wall"}


def test_a_jump_between_two_segments(robot):
    late = replace(LEAVE, waypoints=(at(0.06), at(END)))
    jump = f"{LEAVING}: the segment begins where the arm is not: slide jumps by 0.03 m"
    assert found(robot, moved_by(DROP, late))[0] == jump


def test_a_dropped_action(robot):
    told = lines(robot, (DROP,))
    assert told[0] == ("action 1 drop([], {}), leave: the segment begins where the arm is not: slide jumps by 0.03 m")
    assert told[1] == "action 1 drop([], {}), leave: the gripper lets go of 'box', and holds nothing"


def test_a_joint_beyond_its_limits(robot):
    bent = replace(LEAVE, waypoints=(at(CARRIED), at(0.51), at(END)))
    assert found(robot, moved_by(DROP, bent)) == [
        f"{LEAVING}, waypoint 1.00: slide is at 0.5100 m, and its limits are -0.3000 and 0.5000 m"
    ]


def test_a_way_out_of_all_bounds_is_not_followed(robot):
    """It would take for ever."""
    far = replace(LEAVE, waypoints=(at(CARRIED), at(1e12), at(END)))
    assert found(robot, moved_by(DROP, far)) == [
        f"{LEAVING}, waypoint 1.00: slide is at 1e+12 m, and its limits are -0.3000 and 0.5000 m"
    ]


def test_a_robot_that_touches_itself(robot):
    fold = Segment("fold", (at(0.0), (0.0, 1.25, 0.0), (0.0, 1.25, 2.5)))
    step = PlannedAction(Action("fold"), Motion((fold,)), State({}, fold.waypoints[-1]))
    told = lines(robot, (step,), State({}, at(0.0)), ())
    assert [re.sub(r"\d+\.\d\d", "#", line) for line in told] == [
        f"action 1 fold([], {{}}), fold, waypoint #: trunk touches {part}, # mm deep" for part in ("hand", "left")
    ]
