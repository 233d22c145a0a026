"""Plans are carried out with motors, friction and gravity: what was verified works, and what does not work is told."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from llm3.errors import InputError
from llm3.interfaces import Executor
from llm3.records import PlanFile
from llm3.types import (
    Event,
    EventKind,
    Execution,
    Held,
    Motion,
    Noise,
    PlannedAction,
    Pose,
    Segment,
    State,
)
from llm3_boxpack.paper_settings import SETTINGS
from llm3_bullet.execution import ExecutionSettings, MotorWorld
from llm3_bullet.tabletop.executor import TabletopExecutor

SETTING = "hard-small"
BOXES = "red_box, blue_box, green_box, tan_box"
Execute = Callable[..., Execution]


@pytest.fixture(scope="module")
def plans(solve) -> dict[str, PlanFile]:
    """A whole plan with times, by robot."""
    solved = {robot: solve(setting=SETTING, seed=0, options={"robot": robot}) for robot in ("panda", "iiwa")}
    assert all(result.solved for result, _ in solved.values())
    return {robot: plan for robot, (_, plan) in solved.items()}


@pytest.fixture(scope="module")
def pick(plans) -> tuple[PlannedAction, ...]:
    """A plan of one action."""
    return plans["panda"].actions[:1]


@pytest.fixture(scope="module")
def name(pick) -> str:
    """The box that it takes."""
    return pick[0].action.objects[0]


@pytest.fixture(scope="module")
def env(domain, plans):
    made = domain.make(domain.instance(SETTING, 0), plans["panda"].options)
    yield made
    made.close()


@pytest.fixture(scope="module")
def executed(env, plans) -> Execute:
    """Plays actions of the plan, or others, on the Panda."""

    def play(actions, noise=Noise(), seed=0, start=None, settings=None) -> Execution:  # noqa: B008  # frozen
        executor = TabletopExecutor(env, noise, settings)
        return executor.execute(start or plans["panda"].start, tuple(actions), np.random.default_rng(seed))

    return play


def told(execution: Execution) -> list[str]:
    return [str(slip) for action in execution.actions for slip in action.slips]


def without(step: PlannedAction, *kinds: EventKind) -> PlannedAction:
    """The action without events of these kinds."""
    segments = (
        replace(s, events=tuple(event for event in s.events if event.kind not in kinds)) for s in step.motion.segments
    )
    return replace(step, motion=Motion(tuple(segments)))


@pytest.mark.parametrize("robot", ["panda", "iiwa"])
def test_a_sound_plan_reaches_its_goal_as_it_says(domain, env, plans, robot):
    plan, instance = plans[robot], domain.instance(SETTING, 0)
    executor = domain.executor(instance, plan.options, Noise())
    assert isinstance(executor, Executor)
    execution = executor.execute(plan.start, plan.actions, np.random.default_rng(0))
    assert told(execution) == []
    assert execution.start.poses.keys() == plan.start.poses.keys()
    for action, step in zip(execution.actions, plan.actions, strict=True):
        assert action.action == step.action
        assert action.seconds > step.motion.duration
        assert action.joint_error_rms <= action.joint_error < 0.001
        assert action.tool_error < 0.001
    assert env.goal(execution.state).achieved
    executor.close()
    executor.close()  # does no harm


def test_the_same_seed_gives_the_same_execution_to_the_last_bit_whatever_was_played_before(executed, pick):
    noise = Noise(0.002, 0.02, 0.001)
    first = executed(pick, noise, 1)
    assert executed(pick, noise, 2) != first
    assert executed(pick, noise, 1) == first


def test_without_noise_it_begins_as_planned(executed, plans):
    start, planned = executed(()).start, plans["panda"].start
    assert start.configuration == pytest.approx(planned.configuration, abs=2e-4)
    for name, pose in planned.poses.items():
        assert start.poses[name].position == pytest.approx(pose.position, abs=2e-4)


def test_noise_of_the_joints_is_in_the_start_and_in_the_tool_but_not_in_what_encoders_tell(executed, pick, plans):
    execution = executed(pick, Noise(joints=0.001), 3)
    off = np.subtract(plans["panda"].start.configuration, execution.start.configuration)
    assert off == pytest.approx(np.random.default_rng(3).normal(0.0, 0.001, 7), abs=3e-4)
    (action,) = execution.actions
    assert action.joint_error < 0.0002 < action.tool_error < 0.01


def test_nothing_is_put_anywhere_while_a_plan_is_played(executed, plans, monkeypatch):
    """No box and no joint gets farther in a time step than it can move."""
    seen = []
    drive = MotorWorld.drive

    def watched(self, target):
        before = [self.box(name)[:3, 3] for name in self.movable], self.configuration
        drive(self, target)
        moved = [np.linalg.norm(self.box(n)[:3, 3] - old) for n, old in zip(self.movable, before[0], strict=True)]
        seen.append((max(moved), np.abs(self.configuration - before[1]).max()))

    monkeypatch.setattr(MotorWorld, "drive", watched)
    executed(plans["panda"].actions[:2])
    boxes, joints = np.array(seen).max(axis=0)
    step = ExecutionSettings().boxes.time_step
    assert 0.0005 < boxes < 3.0 * step
    assert 0.005 < joints < 3.0 * step


# ---- what goes wrong is told -------------------------------------------------------------------------------------


def test_what_is_not_taken_stays_where_it_is(executed, env, plans, name):
    actions = (without(plans["panda"].actions[0], EventKind.ATTACH), plans["panda"].actions[1])
    execution = executed(actions)
    missing, away, *rest = told(execution)
    assert missing == f"{name} is not in the gripper, and should be"
    assert away == f"{name} was not in the gripper when it was to be let go"
    assert all(line.startswith(f"{name} came to rest ") for line in rest)
    assert execution.state.poses[name].position == pytest.approx(plans["panda"].start.poses[name].position, abs=0.001)
    assert f"{name} is not in the basket" in env.goal(execution.state).unmet


def test_what_no_event_takes_is_told_to_be_missing_and_not_to_be_where_it_was_to_be_put(executed, plans, name):
    silent = tuple(
        replace(step, motion=Motion(tuple(replace(segment, events=()) for segment in step.motion.segments)))
        for step in plans["panda"].actions[:2]
    )
    picked, placed = executed(silent).actions
    assert [slip.sentence for slip in picked.slips] == [f"{name} is not in the gripper, and should be"]
    assert placed.slips[0].sentence.startswith(f"{name} came to rest ")


def test_what_is_elsewhere_is_not_taken(executed, plans, pick, name):
    far = Pose((0.2, -0.6, 0.035))
    start = replace(plans["panda"].start, poses={**plans["panda"].start.poses, name: far})
    assert told(executed(pick, start=start)) == [f"{name} was not taken: the fingers closed on nothing"]


def test_what_is_too_slippery_slips_out(executed, pick, name):
    slippery = ExecutionSettings(pad_friction=0.01, pad_spin=0.0)
    execution = executed(pick, settings=slippery)
    assert told(execution)[-1] == f"{name} slipped out of the gripper"
    assert execution.state.held is None


def test_what_is_held_in_the_end_is_in_the_state(executed, pick, name):
    execution = executed(pick)
    held, planned = execution.state.held, pick[0].state.held
    assert isinstance(held, Held)
    assert held.object == name
    assert name not in execution.state.poses
    assert held.grasp.position == pytest.approx(planned.grasp.position, abs=0.001)


def test_a_box_that_stands_aside_is_taken_and_put_down_aside(executed, plans, name):
    planned = plans["panda"].start.poses[name]
    across = replace(planned, position=(planned.position[0], planned.position[1] + 0.003, planned.position[2]))
    start = replace(plans["panda"].start, poses={**plans["panda"].start.poses, name: across})
    execution = executed(plans["panda"].actions[:2], start=start)
    first, last = [action.slips for action in execution.actions]
    for slips, words in ((first, "was taken {} beside the plan"), (last, "came to rest {} from where the plan has it")):
        (slip,) = slips
        figures = f"{slip.measures['position'] * 1000:.1f} mm and {np.degrees(slip.measures['angle']):.1f} degrees"
        assert slip.sentence == f"{name} {words.format(figures)}"
        assert slip.measures["position"] == pytest.approx(0.003, abs=0.001)


# ---- plans that make no sense ------------------------------------------------------------------------------------


def with_event(step: PlannedAction, event: Event) -> PlannedAction:
    first, *rest = step.motion.segments
    return replace(step, motion=Motion((replace(first, events=(event,)), *rest)))


def through(step: PlannedAction, *waypoints: tuple[float, ...]) -> PlannedAction:
    return replace(step, motion=Motion((Segment("transit", waypoints),)))


HERE = (0.0,) * 3 + (-1.0,) + (0.0,) * 3


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (
            lambda step: with_event(step, Event(EventKind.GRIPPER)),
            "an event of the kind 'gripper' lacks its opening",
        ),
        (
            lambda step: with_event(step, Event(EventKind.GRIPPER, opening=0.1)),
            "the gripper is to open to 0.1 m, and its range is 0 to 0.08 m",
        ),
        (
            lambda step: with_event(step, Event(EventKind.GRIPPER, opening=float("nan"))),
            "the gripper is to open to nan m, and its range is 0 to 0.08 m",
        ),
        (lambda step: with_event(step, Event(EventKind.DETACH)), "an event of the kind 'detach' lacks its object"),
        (
            lambda step: with_event(step, Event(EventKind.DETACH, object="moon")),
            f"an event of the kind 'detach' names 'moon', and there is no such thing; there are {BOXES}",
        ),
        (
            lambda step: with_event(step, Event(EventKind.ATTACH, object="red_box")),
            "an event of the kind 'attach' lacks its grasp",
        ),
        (
            lambda step: through(step, HERE, (3.0, *HERE[1:])),
            "panda_joint1 is to go to 2.9, and its limits are -2.8973 to 2.8973",
        ),
    ],
)
def test_a_plan_that_makes_no_sense_is_refused_before_anything_moves(executed, pick, change, sentence):
    with pytest.raises(InputError) as caught:
        executed((change(pick[0]),))
    where = f"action 1 {pick[0].action}"
    assert str(caught.value) in (f"{where}: {sentence}.", f"{where}, transit: {sentence}.")


def test_a_motion_without_end_is_refused(executed, pick):
    for far, seconds in ((1e9, "2e+09"), (1.7e308, "inf")):
        with pytest.raises(InputError) as caught:
            executed((through(pick[0], (-far, *HERE[1:]), HERE, (far, *HERE[1:])),))
        sentence = f"the motions of the plan take {seconds} s, and at most 3600 s are carried out."
        assert str(caught.value) == sentence


def test_a_plan_for_other_boxes_is_refused(executed, pick):
    with pytest.raises(InputError) as caught:
        executed(pick, start=State({}, HERE))
    assert str(caught.value) == f"the plan must start with an empty gripper, and with the poses of {BOXES}."


# ---- many plans ----------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("setting", SETTINGS)
def test_sound_plans_end_with_the_goal_reached(domain, solve, setting):
    missed = []
    for seed in range(5):
        result, plan = solve(setting=setting, seed=seed)
        if result.solved:
            executor = domain.executor(domain.instance(setting, seed), plan.options, Noise())
            execution = executor.execute(plan.start, plan.actions, np.random.default_rng(0))
            world = domain.make(domain.instance(setting, seed), plan.options)
            missed += [seed] * (not world.goal(execution.state).achieved)
            world.close()
            executor.close()
    assert missed == []
