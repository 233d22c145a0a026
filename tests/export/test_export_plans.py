"""A plan becomes a program and a program a plan again, with the same contacts, limits and continuity."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

from llm3 import Registry
from llm3.errors import InputError
from llm3.export import (
    FORMATS,
    Move,
    Program,
    check_program,
    plan_with,
    program_of,
    read_program,
    resampled,
    write_program,
)
from llm3.records import PlanFile, open_plan, read_plan
from llm3.types import EventKind, Verification
from llm3.verification import verify


def verified(plan: PlanFile) -> Verification:
    with open_plan(Registry.discover(), plan) as problem:
        return verify(problem, plan)


def handed_over(plan: PlanFile, name: str, rate: float | None, folder) -> PlanFile:
    """The plan with what was read from a file that it was written to."""
    with open_plan(Registry.discover(), plan) as problem:
        joints = problem.env.joints
    program = program_of(plan)
    check_program(program, joints, plan.start.configuration)
    if rate:
        program = resampled(program, rate, joints)
        check_program(program, joints, plan.start.configuration, quintic=True)
    file = folder / f"program{FORMATS[name].ending}"
    file.write_bytes(write_program(program, name, with_accelerations=bool(rate)))
    read = read_program(file)
    assert read == program
    return plan_with(plan, read)


def assert_sound_with_the_same_contacts(first: Verification, second: Verification) -> None:
    assert first.sound
    assert second.defects == ()
    assert second.deepest_contact == pytest.approx(first.deepest_contact, abs=5e-5)
    assert set(second.clearances) == set(first.clearances)
    for label, gap in first.clearances.items():
        assert second.clearances[label] == pytest.approx(gap, abs=2e-3)


@pytest.mark.parametrize("rate", [None, 30.0])
def test_a_plan_in_the_plane_is_as_sound_when_it_is_read_back(solved, tmp_path, rate):
    plan = read_plan(solved)
    for name in FORMATS:
        other = handed_over(plan, name, rate, tmp_path)
        assert [step.motion.events for step in other.actions] == [step.motion.events for step in plan.actions]
        assert [s.label for step in other.actions for s in step.motion.segments] == [
            s.label for step in plan.actions for s in step.motion.segments
        ]
    assert_sound_with_the_same_contacts(verified(plan), verified(other))


@pytest.mark.pybullet
def test_a_packing_is_as_sound_when_it_is_read_back(command, tmp_path):
    assert command("--domain boxpack --setting easy-small --out run --quiet").code == 0
    plan = read_plan(tmp_path / "work" / "run")
    assert {event.kind for step in plan.actions for event in step.motion.events} == set(EventKind)
    assert_sound_with_the_same_contacts(verified(plan), verified(handed_over(plan, "ros2-json", None, tmp_path)))


@pytest.mark.slow
@pytest.mark.pybullet
@pytest.mark.parametrize("domain", ["boxpack", "boxpack -D robot=iiwa", "blocks", "kitchen", "tabletop2d"])
def test_every_plan_is_as_sound_when_it_is_read_back(command, tmp_path, domain):
    for seed in range(3):
        ended = command(f"--domain {domain} --seed {seed} --out run{seed} --quiet")
        assert ended.code == 0, ended
        plan = read_plan(tmp_path / "work" / f"run{seed}")
        first = verified(plan)
        for number, name in enumerate(FORMATS):
            other = handed_over(plan, name, (None, 50.0, 125.0)[(number + seed) % 3], tmp_path)
            assert_sound_with_the_same_contacts(first, verified(other))


def test_a_robot_that_is_told_of_its_joints_in_another_order_is_the_same(solved):
    plan = read_plan(solved)
    program = program_of(plan)

    def turned(move: Move) -> Move:
        positions, velocities = (
            tuple(row[::-1] for row in rows) for rows in (move.trajectory.positions, move.trajectory.velocities)
        )
        return replace(move, trajectory=replace(move.trajectory, positions=positions, velocities=velocities))

    items = tuple(turned(item) if isinstance(item, Move) else item for item in program.items)
    assert plan_with(plan, Program(program.joints[::-1], program.units[::-1], items)) == plan_with(plan, program)


def test_altered_motions_are_found_by_the_verifier(solved):
    plan = read_plan(solved)
    program = program_of(plan)
    assert not verified(plan_with(plan, replace(program, items=program.items[1:]))).sound


def test_what_is_for_another_robot_or_another_plan_is_refused(solved):
    plan = read_plan(solved)
    program = program_of(plan)
    text = str(plan.actions[0].action)
    missing = Program(("x",), ("m",), ())
    renamed = tuple(replace(item, text="go") for item in program.items if item.action == 1)
    late = (replace(program.items[0], action=99),)
    eventful = tuple(item for item in program.items if item.action == 1 and not isinstance(item, Move))
    for other, sentence in [
        (missing, "the plan is for a robot with the joints x (m), y (m), and the trajectories are for x (m)."),
        (replace(program, items=renamed), f"the trajectories have action 1 go, and the plan has {text}."),
        (
            replace(program, items=late),
            f"the trajectories have action 99 {text}, and the plan has only {len(plan.actions)} actions.",
        ),
        (replace(program, items=eventful), f"action 1 {text}: no motion follows its last event, attach."),
    ]:
        with pytest.raises(InputError) as error:
            plan_with(plan, other)
        assert str(error.value) == sentence


def test_a_plan_without_times_says_how_to_get_them(solved):
    plan = read_plan(solved)
    first, *rest = plan.actions
    segments = tuple(replace(segment, trajectory=None) for segment in first.motion.segments)
    untimed = replace(plan, actions=(replace(first, motion=replace(first.motion, segments=segments)), *rest))
    with pytest.raises(InputError) as error:
        program_of(untimed)
    assert str(error.value) == (
        f"action 1 {first.action}, transit: the plan has no times. Install them with pip install 'llm3[time]', and run "
        "again without --timing none."
    )


def test_a_plan_that_has_no_place_in_a_program_is_refused(solved):
    plan = read_plan(solved)
    with pytest.raises(InputError) as error:
        program_of(replace(plan, joints=()))
    assert str(error.value) == (
        "the plan names no joints, so there is nothing to hand over: domain 'tabletop2d' has none."
    )
    with pytest.raises(InputError) as error:
        program_of(replace(plan, joints=(plan.joints[0],) * 2))
    assert str(error.value) == "the plan cannot be handed over: a program needs joints with different names, not x, x"


def test_a_plan_of_nothing_is_a_program_of_nothing(solved):
    plan = replace(read_plan(solved), actions=())
    for name in FORMATS:
        program = program_of(plan)
        assert FORMATS[name].read(write_program(program, name), "f") == program
        assert program.duration == 0
    assert json.loads(write_program(program, "ros2-json"))["items"] == []
