"""Solved plans stand up to a second opinion, and the second opinion can tell a bad plan."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from recheck import Recheck

from llm3.records import PlanFile
from llm3.types import EventKind, PlannedAction, Pose, Segment
from llm3_boxpack.domain import BoxPack
from llm3_boxpack.instance import BoxpackInstance

SETTINGS = BoxPack.settings


@pytest.mark.parametrize("setting", ["easy-medium", "medium-large", "hard-small"])
def test_a_solved_plan_of_each_box_set_has_no_defect_at_the_planners_own_step(solve, domain, setting):
    result, plan = solve(setting=setting, seed=0)
    assert result.solved
    assert Recheck(plan, domain.instance(setting, 0), finer=1).run() == []


@pytest.mark.slow
@pytest.mark.parametrize("setting", SETTINGS)
def test_nine_of_ten_seeds_are_solved_and_every_plan_has_no_defect_at_a_four_times_finer_step(solve, domain, setting):
    missed = []
    for seed in range(10):
        result, plan = solve(setting=setting, seed=seed)
        assert result.stats.llm_calls <= 20
        if result.solved:
            check = Recheck(plan, domain.instance(setting, seed), finer=4)
            assert check.run() == [], seed
            assert check.configurations > 1000
        else:
            assert result.stats.llm_calls == 20
            assert result.goal.unmet
            missed.append(seed)
    assert len(missed) <= 1, missed


# ---- the second opinion itself -----------------------------------------------------------------------


@pytest.fixture(scope="module")
def instance(domain) -> BoxpackInstance:
    return domain.instance("easy-medium", 1)


@pytest.fixture(scope="module")
def plan(solve) -> PlanFile:
    """A plan cut down to its first two actions, a pick and a place."""
    result, plan = solve(setting="easy-medium", seed=1)
    assert result.solved
    return replace(plan, actions=plan.actions[:2])


def defects(plan: PlanFile, instance: BoxpackInstance) -> list[str]:
    """What is wrong, but for the boxes that the cut plan leaves outside."""
    return [d for d in Recheck(plan, instance, finer=1).run() if "out of the basket" not in d]


def changed(plan: PlanFile, action: int, segment: int, new: Segment) -> PlanFile:
    step = plan.actions[action]
    segments = tuple(new if i == segment else old for i, old in enumerate(step.motion.segments))
    step = replace(step, motion=replace(step.motion, segments=segments))
    return replace(plan, actions=tuple(step if i == action else old for i, old in enumerate(plan.actions)))


def shifted(segment: Segment, index: int, joint: int, by: float) -> Segment:
    """A segment with one waypoint moved."""
    waypoints = np.array(segment.waypoints)
    waypoints[index, joint] += by
    return replace(segment, waypoints=tuple(map(tuple, waypoints.tolist())))


def test_an_honest_plan_has_none(plan, instance):
    assert defects(plan, instance) == []


def test_what_the_cut_plan_leaves_outside_is_a_defect(plan, instance):
    found = Recheck(plan, instance, finer=1).run()
    assert len(found) == 3
    assert all("out of the basket" in defect for defect in found)


def test_a_moved_waypoint_is_one(plan, instance):
    approach = plan.actions[0].motion.segments[1]
    found = defects(changed(plan, 0, 1, shifted(approach, 10, 1, 0.3)), instance)  # the shoulder, downwards
    assert any("touches" in defect for defect in found)
    assert any("begins 3.00e-01 rad from where the arm is" in defect for defect in found)


@pytest.mark.parametrize(("action", "kind"), [(0, "attach"), (1, "detach"), (0, "gripper")])
def test_a_dropped_event_is_one(plan, instance, action, kind):
    retreat = plan.actions[action].motion.segments[2]
    rest = tuple(event for event in retreat.events if event.kind is not EventKind(kind))
    assert len(rest) == 1
    assert defects(changed(plan, action, 2, replace(retreat, events=rest)), instance)


def test_a_joint_beyond_its_limit_is_one(plan, instance):
    transit = plan.actions[0].motion.segments[0]
    first = transit.waypoints[0]
    bent = replace(transit, waypoints=(first, (*first[:6], 2.9), *transit.waypoints[1:]))
    (found,) = defects(changed(plan, 0, 0, bent), instance)
    assert found == f"action 1 {plan.actions[0].action}, transit: leaves the joint limits"


def test_a_box_that_is_elsewhere_is_one(plan, instance):
    name = plan.actions[0].action.objects[0]
    pose = plan.start.poses[name]
    x, y, z = pose.position
    poses = {**plan.start.poses, name: Pose((x + 0.01, y, z), pose.orientation)}
    found = defects(replace(plan, start=replace(plan.start, poses=poses)), instance)
    assert any(f"{name} jumps " in defect and "into the gripper" in defect for defect in found)


def test_a_box_in_the_way_is_one(plan, instance):
    target = plan.actions[1].action.params
    other = next(box.name for box in instance.boxes if box.name != plan.actions[0].action.objects[0])
    poses = {**plan.start.poses, other: Pose((target["x"], target["y"], 0.045))}

    def with_it(step: PlannedAction) -> PlannedAction:
        return replace(step, state=replace(step.state, poses={**step.state.poses, other: poses[other]}))

    crowded = replace(plan, start=replace(plan.start, poses=poses), actions=tuple(map(with_it, plan.actions)))
    assert any(f"touches {other}" in defect for defect in defects(crowded, instance))


def test_a_state_that_physics_would_not_give_is_one(plan, instance):
    step = plan.actions[1]
    name = step.action.objects[0]
    x, y, z = step.state.poses[name].position
    state = replace(step.state, poses={**step.state.poses, name: Pose((x, y, z + 0.02))})
    (found, *_) = defects(replace(plan, actions=(plan.actions[0], replace(step, state=state))), instance)
    assert found == f"action 2 {step.action}: {name} is not where the plan says"


def test_a_gap_between_two_actions_is_one(plan, instance):
    found = defects(replace(plan, actions=plan.actions[1:]), instance)
    assert any("from where the arm is" in defect for defect in found)
