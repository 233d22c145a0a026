"""Solved plans stand up to a second opinion, and the second opinion can tell a bad plan."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from llm3.interfaces import PlanVerifier
from llm3.records import PlanFile
from llm3.types import Action, EventKind, Held, PlannedAction, Pose, Segment, State, Verification
from llm3_boxpack.domain import BoxPack
from llm3_boxpack.paper_settings import SETTINGS

BOXES = "blue_box, green_box, red_box, tan_box"
Verify = Callable[[PlanFile], Verification]


def verifier(plan: PlanFile, setting: str, seed: int) -> PlanVerifier:
    domain = BoxPack()
    return domain.verifier(domain.instance(setting, seed), plan.options)


def verified(plan: PlanFile, setting: str, seed: int) -> Verification:
    return verifier(plan, setting, seed).verify(plan.start, plan.actions)


@pytest.mark.parametrize("robot", ["panda", "iiwa"])
def test_a_solved_plan_has_no_defect(solve, robot):
    result, plan = solve(setting="hard-small", seed=0, options={"robot": robot})
    assert result.solved
    report = verified(plan, "hard-small", 0)
    assert report.defects == ()
    assert report.configurations > 300
    assert 0 <= report.deepest_contact < 0.001
    assert report.clearances["transit"] > 0.004
    assert verified(plan, "hard-small", 0) == report


def test_a_plan_between_walls_has_no_defect(solve):
    result, plan = solve(setting="easy-large", seed=0, options={"walls": "0.03"})
    assert result.solved
    assert verified(plan, "easy-large", 0).defects == ()


@pytest.mark.slow
@pytest.mark.parametrize("setting", SETTINGS)
def test_nine_of_ten_seeds_are_solved_and_no_plan_has_a_defect(solve, setting):
    missed = []
    for seed in range(10):
        result, plan = solve(setting=setting, seed=seed)
        assert result.stats.llm_calls <= 20
        if result.solved:
            assert verified(plan, setting, seed).defects == (), seed
        else:
            assert result.stats.llm_calls == 20
            assert result.goal.unmet
            missed.append(seed)
    assert len(missed) <= 1, missed


# ---- plans that were tampered with -----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def plan(solve) -> PlanFile:
    """A plan without times, cut down to its first two actions, a pick and a place."""
    result, plan = solve(setting="easy-medium", seed=1, timing="none")
    assert result.solved
    return replace(plan, actions=plan.actions[:2])


@pytest.fixture(scope="module")
def name(plan) -> str:
    """The box that it packs."""
    return plan.actions[0].action.objects[0]


@pytest.fixture(scope="module")
def defects(plan) -> Callable[[PlanFile], list[str]]:
    """What is wrong with a plan of this instance, but for the boxes that the cut plan leaves outside."""
    look = verifier(plan, "easy-medium", 1)

    def found(changed: PlanFile) -> list[str]:
        told = map(str, look.verify(changed.start, changed.actions).defects)
        return [line for line in told if "out of the basket" not in line]

    return found


def shape(line: str) -> str:
    """The line with # for its figures."""
    return re.sub(r"(?<![\w.])-?\d+\.\d+(?!\w)", "#", line)


def changed(plan: PlanFile, action: int, segment: int, new: Segment) -> PlanFile:
    step = plan.actions[action]
    segments = tuple(new if i == segment else old for i, old in enumerate(step.motion.segments))
    return with_step(plan, action, replace(step, motion=replace(step.motion, segments=segments)))


def with_step(plan: PlanFile, action: int, step: PlannedAction) -> PlanFile:
    return replace(plan, actions=tuple(step if i == action else old for i, old in enumerate(plan.actions)))


def shifted(segment: Segment, index: int | slice, joint: int, by: float) -> Segment:
    """A segment with one waypoint, or some, moved."""
    waypoints = np.array(segment.waypoints)
    waypoints[index, joint] += by
    return replace(segment, waypoints=tuple(map(tuple, waypoints.tolist())))


def test_an_honest_plan_has_none(plan, defects):
    assert defects(plan) == []


def test_what_the_cut_plan_leaves_outside_is_a_defect(plan, name):
    told = [shape(str(defect)) for defect in verified(plan, "easy-medium", 1).defects]
    left = sorted(set(plan.start.poses) - {name})
    assert sorted(told) == [f"{other} ends # mm out of the basket" for other in left]


def test_what_ends_in_the_gripper_is_a_defect(plan, name, defects):
    assert defects(replace(plan, actions=plan.actions[:1])) == [f"{name} ends in the gripper"]


def test_what_one_action_hides_in_its_motion_is_one(solve, defects):
    """A pick that first carries out the two actions before it."""
    _, whole = solve(setting="easy-medium", seed=1, timing="none")
    first, second, third = whole.actions[:3]
    segments = tuple(segment for step in (first, second, third) for segment in step.motion.segments)
    merged = replace(third, motion=replace(third.motion, segments=segments))
    told = defects(replace(whole, actions=(merged,)))
    (other,) = first.action.objects
    (name,) = third.action.objects
    assert told == [
        f"action 1 {third.action}: the gripper lets go of {other}, and only takes something in a pick",
        f"{name} ends in the gripper",
    ]


def test_a_waypoint_moved_into_the_table_is_one(plan, defects):
    approach = shifted(plan.actions[0].motion.segments[1], 5, 1, 0.3)  # the shoulder, downwards
    where = f"action 1 {plan.actions[0].action}, approach, waypoint #: "
    told = list(map(shape, defects(changed(plan, 0, 1, approach))))
    assert where + "panda_hand touches table, # mm deep" in told or (
        where + "panda_leftfinger touches table, # mm deep" in told
    )
    assert all(line.startswith(where) and line.endswith(", # mm deep") for line in told)


def test_a_shifted_segment_is_one(plan, defects):
    transit = shifted(plan.actions[0].motion.segments[0], slice(None), 6, 0.01)
    told = defects(changed(plan, 0, 0, transit))
    where = f"action 1 {plan.actions[0].action}"
    assert told == [
        f"{where}, transit: the segment begins where the arm is not: panda_joint7 jumps by 0.01 rad",
        f"{where}, approach: the segment begins where the arm is not: panda_joint7 jumps by 0.01 rad",
    ]


def test_a_joint_beyond_its_limit_is_one(plan, defects):
    transit = plan.actions[0].motion.segments[0]
    first = transit.waypoints[0]
    bent = replace(transit, waypoints=(first, (*first[:6], 2.9), *transit.waypoints[1:]))
    assert defects(changed(plan, 0, 0, bent)) == [
        f"action 1 {plan.actions[0].action}, transit, waypoint 1.00: panda_joint7 is at 2.9000 rad, and its limits are "
        "-2.8973 and 2.8973 rad"
    ]


@pytest.mark.parametrize(
    ("action", "kind", "sentence"),
    [
        (0, "attach", "action 1 {0}: the gripper holds nothing, and the state after it says {2}"),
        (1, "detach", "action 2 {1}: the gripper holds {2}, and the state after it says nothing"),
        (0, "gripper", "action 1 {0}, lift: panda_leftfinger is # mm from {2}, which it takes"),
    ],
)
def test_a_dropped_event_is_one(plan, name, defects, action, kind, sentence):
    last = plan.actions[action].motion.segments[2]
    rest = tuple(event for event in last.events if event.kind is not EventKind(kind))
    assert len(rest) == 1
    told = list(map(shape, defects(changed(plan, action, 2, replace(last, events=rest)))))
    actions = (shape(str(step.action)) for step in plan.actions)
    assert sentence.format(*actions, name) in told


def test_a_box_that_is_elsewhere_is_one(plan, name, defects):
    pose = plan.start.poses[name]
    x, y, z = pose.position
    poses = {**plan.start.poses, name: Pose((x + 0.01, y, z), pose.orientation)}
    told = list(map(shape, defects(replace(plan, start=replace(plan.start, poses=poses)))))
    assert f"action 1 {plan.actions[0].action}, lift: {name} jumps by # mm into the gripper" in told


def test_a_box_in_the_way_is_one(plan, name, defects):
    target = plan.actions[1].action.params
    other = next(box for box in plan.start.poses if box != name)
    poses = {**plan.start.poses, other: Pose((target["x"], target["y"], 0.045))}

    def with_it(step: PlannedAction) -> PlannedAction:
        return replace(step, state=replace(step.state, poses={**step.state.poses, other: poses[other]}))

    crowded = replace(plan, start=replace(plan.start, poses=poses), actions=tuple(map(with_it, plan.actions)))
    told = list(map(shape, defects(crowded)))
    where = f"action 2 {shape(str(plan.actions[1].action))}, descend, waypoint #"
    assert f"{where}: {name} touches {other}, # mm deep" in told


def test_a_state_that_physics_would_not_give_is_one(plan, name, defects):
    step = plan.actions[1]
    x, y, z = step.state.poses[name].position
    lifted = replace(step.state, poses={**step.state.poses, name: Pose((x, y, z + 0.02))})
    told = defects(with_step(plan, 1, replace(step, state=lifted)))
    where = f"action 2 {step.action}"
    assert [shape(line) for line in told] == [
        shape(f"{where}: {name} is # mm from where the state after it says"),
        shape(f"{where}: {name} rests on nothing: the next thing is # mm away"),
    ]


def test_a_dropped_action_is_one(plan, name, defects):
    told = list(map(shape, defects(replace(plan, actions=plan.actions[1:]))))
    where = shape(f"action 1 {plan.actions[1].action}")
    assert re.fullmatch(
        re.escape(f"{where}, transit: the segment begins where the arm is not: ") + r"panda_joint\d jumps by # rad",
        told[0],
    )
    assert f"{where}, retreat: the gripper lets go of '{name}', and holds nothing" in told
    assert f"{where}: the gripper does not let go of {name}" in told


# ---- actions that do not do what they say ----------------------------------------------------------------------------


def test_a_pick_of_another_box_is_one(plan, name, defects):
    step = replace(plan.actions[0], action=Action("pick", ("tan_box" if name != "tan_box" else "red_box",)))
    (told,) = defects(with_step(plan, 0, step))
    assert told == f"action 1 {step.action}: the gripper does not hold {step.action.objects[0]} after it"


def test_a_place_elsewhere_is_one(plan, name, defects):
    step = plan.actions[1]
    x, y, theta = step.action.params.values()
    elsewhere = replace(step.action, params={"x": x + 0.01, "y": y, "theta": theta + 0.1})
    told = defects(with_step(plan, 1, replace(step, action=elsewhere)))
    let_go = re.escape(f"action 2 {elsewhere}: {name} is let go at ")
    assert len(told) == 2
    spot = re.escape(f", not at ({x + 0.01:.4f}, {y:.4f})")
    assert re.fullmatch(rf"{let_go}\(-?[0-9.]+, -?[0-9.]+\){spot}", told[0])
    assert re.fullmatch(rf"{let_go}an angle of -?[0-9.]+ rad, not {theta + 0.1:.3f} rad", told[1])


def test_a_half_turn_of_the_box_is_one(plan, name, defects):
    step = plan.actions[1]
    turned = replace(step.action, params={**step.action.params, "theta": step.action.params["theta"] - 3.1})
    (told,) = defects(with_step(plan, 1, replace(step, action=turned)))
    assert " is let go at an angle of " in told


@pytest.mark.parametrize(
    "start",
    [
        lambda start, name: replace(start, poses={k: v for k, v in start.poses.items() if k != name}),
        lambda start, name: replace(start, poses={**start.poses, "puce_box": start.poses[name]}),
        lambda start, name: replace(start, held=Held("puce_box", Pose((0.0, 0.0, 0.0)))),
    ],
)
def test_a_start_that_cannot_be_played(plan, name, defects, start):
    assert defects(replace(plan, start=start(plan.start, name))) == [
        "the plan must start with an empty gripper, and with the poses of red_box, blue_box, green_box, tan_box"
    ]


def test_actions_that_do_not_exist_do_no_harm(plan, defects):
    """The core tells of them."""
    strange = (Action("fly", ("red_box",)), Action("pick"), Action("place", ("a", "b")), Action("place", ("red_box",)))
    steps = tuple(PlannedAction(action, replace(plan.actions[0].motion, segments=()), plan.start) for action in strange)
    assert defects(replace(plan, actions=steps)) == [
        "action 4 place(['red_box'], {}): the gripper does not let go of red_box"
    ]


def test_a_place_without_a_place_does_no_harm(plan, defects):
    step = plan.actions[1]
    assert defects(with_step(plan, 1, replace(step, action=replace(step.action, params={"x": 0.5})))) == []


def test_an_empty_plan_is_only_short_of_the_goal(plan):
    told = verified(replace(plan, actions=()), "easy-medium", 1)
    assert [shape(str(defect)).partition(" ")[2] for defect in told.defects] == ["ends # mm out of the basket"] * 4
    assert told.configurations == 0
    assert isinstance(plan.start, State)
