"""Solved plans stand up to a second opinion, and the second opinion can tell a bad plan."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

import pytest
from plane_world import DOMAIN, box, disc, done, moved, pick, place, problem, push, wall

from llm3.types import Event, EventKind, Held, Motion, PlannedAction, Pose, Segment, State, Verification
from llm3_tabletop2d.env import TabletopEnv

INSTANCE = problem(
    disc("red_disc", 0.3, 0.4), box("grey_box", 0.8, 0.2, theta=0.3), walls=(wall("post", 0.6, 0.7, 0.04, 0.2),)
)
Plan = tuple[PlannedAction, ...]
Spoil = Callable[[Plan], Plan]


@pytest.fixture(scope="module")
def start() -> State:
    return TabletopEnv(INSTANCE, 0.03).reset()


@pytest.fixture(scope="module")
def plan(start) -> Plan:
    """A pick, a place and a push, which reach the goal."""
    env = TabletopEnv(INSTANCE, 0.03)
    return done(env, start, pick("red_disc"), place("red_disc", 1.05, 0.4), push("grey_box", 0.7, 0.2))


def verified(start: State, plan: Plan) -> Verification:
    return DOMAIN.verifier(INSTANCE, {"robot_radius": "0.03"}).verify(start, plan)


def with_segment(plan: Plan, number: int, label: str, **changes: object) -> Plan:
    """The plan with other fields in one segment."""
    step = plan[number]
    segments = tuple(replace(s, **changes) if s.label == label else s for s in step.motion.segments)
    return (*plan[:number], replace(step, motion=Motion(segments)), *plan[number + 1 :])


def segment(plan: Plan, number: int, label: str) -> Segment:
    (found,) = [s for s in plan[number].motion.segments if s.label == label]
    return found


def with_state(plan: Plan, number: int, state: State) -> Plan:
    return (*plan[:number], replace(plan[number], state=state), *plan[number + 1 :])


def with_action(plan: Plan, number: int, action) -> Plan:
    return (*plan[:number], replace(plan[number], action=action), *plan[number + 1 :])


def test_a_sound_plan_has_no_defect(start, plan):
    report = verified(start, plan)
    assert report.defects == ()
    assert report.deepest_contact == 0.0
    assert set(report.clearances) <= {"transit", "approach", "withdraw", "advance", "retreat", "push"}
    assert verified(start, plan) == report


def through_the_box(plan: Plan) -> Plan:
    way = segment(plan, 0, "transit").waypoints
    return with_segment(plan, 0, "transit", waypoints=(way[0], (0.8, 0.2), way[-1]))


def through_the_post(plan: Plan) -> Plan:
    way = segment(plan, 1, "transit").waypoints
    return with_segment(plan, 1, "transit", waypoints=(way[0], (0.6, 0.7), way[-1]))


def out_of_the_room(plan: Plan) -> Plan:
    way = segment(plan, 0, "transit").waypoints
    return with_segment(plan, 0, "transit", waypoints=(way[0], (0.02, 0.4), way[-1]))


def a_jump(plan: Plan) -> Plan:
    return with_segment(plan, 0, "transit", waypoints=((0.12, 0.4), segment(plan, 0, "transit").waypoints[-1]))


def from_afar(plan: Plan) -> Plan:
    """It takes hold of the disc before it comes close."""
    attach = segment(plan, 0, "withdraw").events
    return with_segment(with_segment(plan, 0, "withdraw", events=()), 0, "approach", events=attach)


def not_taken(plan: Plan) -> Plan:
    return with_segment(plan, 0, "withdraw", events=())


def kept(plan: Plan) -> Plan:
    return with_segment(plan, 1, "retreat", events=())


def something_else(plan: Plan) -> Plan:
    (event,) = segment(plan, 0, "withdraw").events
    return with_segment(plan, 0, "withdraw", events=(replace(event, object="ghost"),))


def taken_twice(plan: Plan) -> Plan:
    attach = segment(plan, 0, "withdraw").events
    return with_segment(plan, 1, "advance", events=attach)


def pulled(plan: Plan) -> Plan:
    """The push goes there and back, and a bit farther."""
    way = segment(plan, 2, "push").waypoints
    return with_segment(plan, 2, "push", waypoints=(way[0], way[1], way[0], way[1]))


def a_wrong_state(plan: Plan) -> Plan:
    return with_state(plan, 1, moved(plan[1].state, "red_disc", 1.0, 0.4))


def a_wrong_hold(plan: Plan) -> Plan:
    state = plan[0].state
    poses = {name: pose for name, pose in state.poses.items() if name != "grey_box"}
    return with_state(plan, 0, replace(state, poses=poses, held=Held("grey_box", Pose((0.0, 0.0, 0.0)))))


def a_wrong_robot(plan: Plan) -> Plan:
    return with_state(plan, 2, replace(plan[2].state, configuration=(0.5, 0.5)))


def another_place(plan: Plan) -> Plan:
    return with_action(plan, 1, place("red_disc", 1.02, 0.4))


def another_object(plan: Plan) -> Plan:
    return with_action(plan, 2, push("red_disc", 1.05, 0.4))


def nothing_done(plan: Plan) -> Plan:
    return plan[:1]


FAULTS: list[tuple[Spoil, str]] = [
    (through_the_box, r"action 1 .*, transit, waypoint .*: robot is in grey_box, 29\.\d mm deep"),
    (through_the_post, r"action 2 .*, transit, waypoint .*: robot is in post, \d+\.\d mm deep"),
    (out_of_the_room, r"action 1 .*, transit, waypoint .*: robot is in outer_wall, 10\.0 mm deep"),
    (a_jump, r"action 1 .*, transit: the segment begins 20\.0 mm from where the robot is"),
    (from_afar, r"action 1 .*, approach: the robot takes hold of red_disc from 12\.0 mm away"),
    (not_taken, r"action 1 .*: the robot does not hold red_disc after it"),
    (not_taken, r"action 2 .*, retreat: the robot lets go of red_disc, which it does not hold"),
    (kept, r"action 2 .*: the robot holds red_disc after it"),
    (kept, r"action 2 .*: the robot holds red_disc, and the plan says nothing"),
    (something_else, r"action 1 .*, withdraw: nothing that can be moved is called 'ghost'"),
    (taken_twice, r"action 2 .*, advance: the robot takes hold of red_disc while it holds red_disc"),
    (pulled, r"action 3 .*: the robot is not behind grey_box where it moves it"),
    (a_wrong_state, r"action 2 .*: red_disc is at \(1\.0500, 0\.4000\), and the plan says otherwise"),
    (a_wrong_hold, r"action 1 .*: the robot holds red_disc, and the plan says grey_box"),
    (a_wrong_robot, r"action 3 .*: the robot is at \(0\.\d+, 0\.2000\), and the plan says otherwise"),
    (another_place, r"action 2 .*: red_disc is at \(1\.0500, 0\.4000\), not at \(1\.0200, 0\.4000\)"),
    (another_object, r"action 3 .*: grey_box was moved, and the action is about something else"),
    (nothing_done, r"red_disc ends in the robot's hold"),
]


@pytest.mark.parametrize(("spoil", "sentence"), FAULTS)
def test_a_fault_is_told(start, plan, spoil, sentence):
    told = [str(defect) for defect in verified(start, spoil(plan)).defects]
    assert any(re.fullmatch(sentence, line) for line in told), told


def test_an_empty_plan_misses_the_goal(start):
    (defect,) = verified(start, ()).defects
    assert str(defect) == "red_disc ends 690.0 mm out of tray"


def test_a_start_that_says_too_little_is_told(start):
    (defect,) = verified(replace(start, poses={}), ()).defects
    assert str(defect) == "the plan must start with nothing held, and with the poses of red_disc, grey_box"


def test_a_trajectory_is_looked_at_as_well(solve):
    _, plan, report = solve(setting="push", seed=0, timing="toppra")
    assert report.defects == ()
    verifier = DOMAIN.verifier(DOMAIN.instance("push", 0), {"robot_radius": "0.03"})
    step = plan.actions[0]
    first = step.motion.segments[0]

    def told(**changes: object) -> str:
        segments = (replace(first, trajectory=replace(first.trajectory, **changes)), *step.motion.segments[1:])
        spoilt = (replace(step, motion=Motion(segments)), *plan.actions[1:])
        return "\n".join(map(str, verifier.verify(plan.start, spoilt).defects))

    fast = tuple(t / 2 for t in first.trajectory.times)
    assert re.search(r": the speed reaches \d\.\d+ m/s, and the limit is 0\.5 m/s", told(times=fast))
    assert re.search(r": the acceleration reaches \d+\.\d+ m/s², and the limit is 1 m/s²", told(times=fast))
    aside = tuple((x + 0.01, y) for x, y in first.trajectory.positions)
    assert "the trajectory is not where the waypoints are" in told(positions=aside)


def test_a_gripper_event_means_nothing_here(start, plan):
    event = Event(EventKind.GRIPPER, opening=0.1, object="red_disc")
    assert verified(start, with_segment(plan, 0, "transit", events=(event,))).defects == ()
