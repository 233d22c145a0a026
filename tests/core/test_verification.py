"""A second look at a plan: what the core holds against the domain's own words, and what it leaves to its verifier."""

from __future__ import annotations

from dataclasses import replace

import pytest
from line_world import FINISH, FullLineDomain, LineDomain, LineInstance, LinePlugin, go, line_registry

from llm3 import Registry, hookimpl
from llm3.assembly import open_problem
from llm3.errors import InputError, MissingCapability, PluginError, UnknownName
from llm3.interfaces import Joint, PlanVerifier
from llm3.records import PlanFile, open_plan
from llm3.types import Action, Defect, Motion, PlannedAction, Segment, State, Trajectory, Verification
from llm3.verification import verify

SEEN = Verification((Defect("it wobbles", 1, "go([], {'x': 9.0})", "roll", 0.5),), 7, 0.25, {"roll": 0.1})


class Sharp(PlanVerifier):
    """Answers what it was made with, and remembers what it was asked."""

    def __init__(self, answer):
        self.answer, self.asked = answer, []

    def verify(self, start, actions):
        self.asked.append((start, actions))
        if isinstance(self.answer, Exception):
            raise self.answer
        return self.answer


class VerifiedLine(LineDomain):
    """The line with a verifier, which is handed in."""

    sharp = Sharp(Verification(configurations=3))

    def verifier(self, instance, options):
        assert isinstance(instance, LineInstance)
        assert set(options) == {"ground", "colour"}
        return self.sharp


def rolled(start, end, state=None, action=None):
    """An action that rolls straight from one place to another."""
    motion = Motion((Segment("roll", ((start,), (end,))),))
    return PlannedAction(action or go(end), motion, state or State(configuration=(end,), facts={"coin": False}))


START = State(configuration=(0.0,), facts={"coin": False})
PLAN = PlanFile(
    "llm3-plan/1",
    "line",
    {"start": 0.0},
    {"ground": "dry", "colour": "red"},
    (Joint("wheel", "m"),),
    START,
    (rolled(0.0, FINISH),),
)


def second_look(plan, verifier=None, domain=VerifiedLine):
    """What is found in a plan; without a verifier the domain's own finds nothing."""
    made = domain()
    if verifier:
        made.sharp = verifier
    with open_problem(made, LineInstance(**plan.instance), plan.options) as problem:
        return verify(problem, plan)


def lines(plan):
    return [str(defect) for defect in second_look(plan).defects]


def test_a_sound_plan():
    assert second_look(PLAN) == Verification(configurations=3)
    assert second_look(PLAN).sound


def test_the_verifier_is_given_the_plan_and_its_findings_are_kept():
    sharp = Sharp(SEEN)
    assert second_look(PLAN, sharp) == SEEN
    assert sharp.asked == [(PLAN.start, PLAN.actions)]
    assert not SEEN.sound
    assert str(SEEN.defects[0]) == "action 1 go([], {'x': 9.0}), roll, waypoint 0.50: it wobbles"


def test_what_the_core_finds_stands_around_it():
    plan = replace(PLAN, start=replace(START, configuration=(1.0,)), actions=(rolled(1.0, 2.0),))
    assert [str(defect) for defect in second_look(plan, Sharp(SEEN)).defects] == [
        "the plan does not start where the problem does: configuration is [1.0], not [0.0]",
        str(SEEN.defects[0]),
        "by its last state, the plan misses the goal: the robot is not at the finish",
    ]


def test_another_start_is_told_part_by_part():
    start = replace(PLAN.start, facts={"coin": True})
    assert lines(replace(PLAN, start=start)) == [
        'the plan does not start where the problem does: facts is {"coin":true}, not {"coin":false}'
    ]


@pytest.mark.parametrize(
    ("action", "sentence"),
    [
        (Action("fly"), "unknown action 'fly': the actions are go, take"),
        (go(10.5), "x = 10.5 is out of range: it must be from 0 to 10 m"),
        (Action("go"), "go lacks x: give a number from 0 to 10 m"),
        (Action("take", ("moon",)), "unknown object 'moon': the objects are coin"),
        (Action("go", (), {"x": 9.0, "y": 1.0}), "go has no parameter 'y': it takes x"),
    ],
)
def test_what_is_no_action_of_the_problem(action, sentence):
    told = lines(replace(PLAN, actions=(rolled(0.0, FINISH, action=action),)))
    assert told == [f"action 1 {action}: {sentence}"]


def test_a_plan_that_ends_short_of_the_goal():
    assert lines(replace(PLAN, actions=(rolled(0.0, 8.0),))) == [
        "by its last state, the plan misses the goal: the robot is not at the finish"
    ]
    assert lines(replace(PLAN, actions=())) == lines(replace(PLAN, actions=(rolled(0.0, 8.0),)))


def test_a_domain_without_a_verifier():
    with pytest.raises(MissingCapability) as caught:
        second_look(PLAN, domain=LineDomain)
    assert str(caught.value) == "domain 'line' has no verifier, which 'llm3 verify' needs."


def test_a_verifier_that_fails_is_named():
    with pytest.raises(PluginError, match=r"^Sharp\.verify raised ValueError: oops \(test_verification\.py:\d+\)\.$"):
        second_look(PLAN, Sharp(ValueError("oops")))
    with pytest.raises(PluginError, match=r"^Sharp\.verify must answer Verification, not tuple\.$"):
        second_look(PLAN, Sharp(()))


# ---- from a plan to its problem --------------------------------------------------------------------------------------


def complaint(plan, error=InputError):
    with pytest.raises(error) as caught, open_plan(line_registry(), plan):
        pass
    return str(caught.value)


def test_a_plan_opens_its_problem():
    with open_plan(line_registry(), replace(PLAN, options={"ground": "wet"})) as problem:
        assert problem.instance == LineInstance(0.0)
        assert problem.options == {"ground": "wet", "colour": "red"}
        assert problem.env.reset() == PLAN.start


def test_the_names_in_a_plan_must_be_known():
    assert complaint(replace(PLAN, domain="lime"), UnknownName) == (
        "unknown domain 'lime'; did you mean 'line'? Known: full-line, line."
    )
    assert complaint(replace(PLAN, options={"walls": "1"}), UnknownName) == (
        "unknown option 'walls' of domain 'line'. Known: colour, ground."
    )
    assert complaint(replace(PLAN, options={"ground": "muddy"}), UnknownName) == (
        "unknown value 'muddy' of option 'ground'. Known: dry, wet."
    )


def test_the_instance_of_a_plan_must_be_one():
    assert complaint(replace(PLAN, instance={"start": "here"})) == (
        'the plan\'s instance: Expected `float`, got `str` "here" - at `$.start`'
    )
    assert (
        complaint(replace(PLAN, instance={"start": 11.0}))
        == "the plan's instance: start must be from 0 to 10, not 11.0"
    )


def test_the_joints_of_a_plan_must_be_the_robots():
    assert complaint(replace(PLAN, joints=(Joint("wheel"), Joint("arm")))) == (
        "the plan is for a robot with the joints wheel (rad), arm (rad), but the robot has wheel (m)."
    )
    assert complaint(replace(PLAN, joints=())) == (
        "the plan is for a robot with the joints none, but the robot has wheel (m)."
    )


def with_segment(segment):
    return replace(PLAN, actions=(replace(PLAN.actions[0], motion=Motion((segment,))),))


@pytest.mark.parametrize(
    ("plan", "sentence"),
    [
        (
            replace(PLAN, start=replace(START, configuration=())),
            "the plan has 0 joint values in the start, and the robot needs 1.",
        ),
        (
            replace(PLAN, actions=(rolled(0.0, 9.0, State(configuration=(9.0, 1.0))),)),
            "the plan has 2 joint values in the state after action 1, and the robot needs 1.",
        ),
        (
            with_segment(Segment("roll", ((0.0,), (9.0, 9.0)))),
            "the plan has 2 joint values in segment 'roll' of action 1, and the robot needs 1.",
        ),
        (
            with_segment(
                Segment("roll", ((0.0,), (9.0,)), trajectory=Trajectory((0.0,), ((0.0, 0.0),), ((0.0, 0.0),)))
            ),
            "the plan has 2 joint values in segment 'roll' of action 1, and the robot needs 1.",
        ),
        (with_segment(Segment("roll", ())), "the plan has no waypoints in segment 'roll' of action 1."),
    ],
)
def test_all_configurations_of_a_plan_must_fit(plan, sentence):
    assert complaint(plan) == sentence


def test_a_world_that_a_plan_does_not_fit_is_closed_again():
    made = []

    class Watched(FullLineDomain):
        name = "watched"

        def make(self, instance, options):
            made.append(super().make(instance, options))
            return made[-1]

    class Plugin(LinePlugin):
        @hookimpl
        def llm3_domains(self):
            return {"watched": Watched}

    registry = Registry()
    registry.register(Plugin(), "watched (test)")
    with pytest.raises(InputError):
        open_plan(registry, replace(PLAN, domain="watched", joints=()))
    assert [env.closed for env in made] == [1]
