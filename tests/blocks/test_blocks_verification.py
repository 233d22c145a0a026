"""A second look at plans: sound ones pass, and what is wrong with the others is told."""

from __future__ import annotations

from dataclasses import replace

import pytest

from llm3.records import PlanFile, open_plan
from llm3.registry import Registry
from llm3.types import Action, PlannedAction, Pose
from llm3.verification import verify
from llm3_blocks.domain import Blocks

SETTING, SEED = "blocks-4", 0


@pytest.fixture(scope="module")
def plan(solve) -> PlanFile:
    """Of six actions: pick, place, pick, stack, pick, stack."""
    result, plan = solve(setting=SETTING, seed=SEED)
    assert result.solved
    assert [step.action.name for step in plan.actions] == ["pick", "place", "pick", "stack", "pick", "stack"]
    return plan


def defects(plan: PlanFile) -> list[str]:
    """What the domain's verifier tells; the core's own checks are not asked."""
    verifier = Blocks().verifier(Blocks().instance(SETTING, SEED), {"robot": "panda"})
    return [str(defect) for defect in verifier.verify(plan.start, plan.actions).defects]


def with_action(plan: PlanFile, index: int, action: Action) -> PlanFile:
    steps = list(plan.actions)
    steps[index] = replace(steps[index], action=action)
    return replace(plan, actions=tuple(steps))


def test_a_plan_of_the_stand_in_is_sound(plan):
    with open_plan(Registry.discover(), plan) as problem:
        assert verify(problem, plan).defects == ()


def test_a_pick_of_another_block_is_one(plan):
    assert defects(with_action(plan, 4, Action("pick", ("red_block",)))) == [
        "action 5 pick(['red_block'], {}): the gripper does not hold red_block after it"
    ]


def test_a_place_elsewhere_is_one(plan):
    step = plan.actions[1]
    action = replace(step.action, params={**step.action.params, "x": step.action.params["x"] + 0.05})
    (told,) = defects(with_action(plan, 1, action))
    assert told.startswith(f"action 2 {action}: blue_block is let go at (")


def test_a_stack_on_another_block_is_one(plan):
    (told,) = defects(with_action(plan, 3, Action("stack", ("green_block", "red_block"))))
    assert told.startswith("action 4 stack(['green_block', 'red_block'], {}): green_block is let go at (")


def test_a_stack_of_what_is_not_let_go_is_one(plan):
    assert defects(with_action(plan, 3, Action("stack", ("red_block", "blue_block")))) == [
        "action 4 stack(['red_block', 'blue_block'], {}): the gripper does not let go of red_block"
    ]


def test_a_plan_that_ends_too_early_misses_the_goal(plan):
    assert defects(replace(plan, actions=plan.actions[:4])) == [
        "yellow_block does not end on red_block: they do not touch"
    ]
    assert defects(replace(plan, actions=plan.actions[:5])) == ["yellow_block ends in the gripper"]


def test_a_block_that_ends_beside_the_one_below_is_one(plan):
    last = plan.actions[-1]
    x, y, z = last.state.poses["yellow_block"].position
    orientation = last.state.poses["yellow_block"].orientation
    beside = {**last.state.poses, "yellow_block": Pose((x + 0.035, y, z), orientation)}
    told = defects(replace(plan, actions=(*plan.actions[:-1], replace(last, state=replace(last.state, poses=beside)))))
    assert told[-1].startswith("yellow_block ends with its centre ")
    assert told[-1].endswith(" mm beside red_block")


def test_actions_that_do_not_exist_do_no_harm(plan):
    """The core tells of them."""
    strange = (Action("fly", ("red_block",)), Action("pick"), Action("stack", ("red_block",)), Action("stack"))
    still = replace(plan.actions[0].motion, segments=())
    steps = tuple(PlannedAction(action, still, plan.start) for action in strange)
    told = defects(replace(plan, actions=steps))
    assert not any(line.startswith("action") for line in told)


def test_an_empty_plan_is_only_short_of_the_goal(plan):
    assert defects(replace(plan, actions=())) == [
        "yellow_block does not end on red_block: they do not touch",
        "blue_block does not end on table: they do not touch",
        "green_block does not end on blue_block: they do not touch",
    ]
