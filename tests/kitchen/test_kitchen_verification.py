"""The second look: a plan of the stand-in is clean, and each thing that is changed in it is told."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from kitchen_world import BREAD, KITCHEN, POTATO, SERVING, SINK, after, pick, place, planned, wash

from llm3.types import Action, Motion, PlannedAction, Pose
from llm3_bullet.robots.panda import panda
from llm3_kitchen.instance import KitchenInstance
from llm3_kitchen.meals import PLACES
from llm3_kitchen.verification import KitchenVerifier

MEAL = KitchenInstance(PLACES, (POTATO,))
ACTIONS = (
    pick("potato"),
    place("potato", "sink", SINK),
    wash("potato"),
    pick("potato"),
    place("potato", "serving", SERVING),
)


@pytest.fixture(scope="module")
def start(make):
    return make(MEAL).reset()


@pytest.fixture(scope="module")
def steps(make, start):
    return planned(make(MEAL), start, *ACTIONS)


def told(start, steps, instance=MEAL):
    """All defects, with # for figures."""
    found = KitchenVerifier(instance, panda()).verify(start, tuple(steps))
    return [re.sub(r"-?\d+\.\d+", "#", str(defect)) for defect in found.defects]


def changed(steps, index, **fields):
    return [*steps[:index], replace(steps[index], **fields), *steps[index + 1 :]]


def with_facts(step, **facts):
    return replace(step.state, facts={**step.state.facts, **{k.replace("_", " "): v for k, v in facts.items()}})


def test_a_meal_is_clean(start, steps):
    assert told(start, steps) == []


def test_what_was_never_washed_is_told(start, steps):
    raw = [replace(step, state=with_facts(step, potato_washed=False)) for step in (*steps[:2], *steps[3:])]
    assert told(start, raw) == ["potato was never washed"]


def test_what_was_never_heated_is_told(start, steps):
    hot = replace(MEAL, foods=(replace(POTATO, heated=True),))
    assert told(start, steps, hot) == ["potato was never heated"]


def test_washing_beside_the_sink_is_told(start, steps):
    assert told(start, [steps[0], steps[1], *steps[3:], replace(steps[2], state=steps[4].state)])[-1] == (
        "action 5 wash(['potato'], {}): potato does not stand in a place of the kind 'sink'"
    )


def test_washing_what_is_held_is_told(start, steps):
    early = replace(steps[2], state=with_facts(steps[0], potato_washed=True))
    lines = told(start, [steps[0], early, replace(steps[1], state=steps[2].state), *steps[3:]])
    assert lines == ["action 2 wash(['potato'], {}): the gripper holds potato, and must be empty"]


def test_heating_what_was_not_washed_is_told(start, steps):
    state = with_facts(steps[1], potato_heated=True)
    heated = PlannedAction(Action("heat", ("potato",)), Motion(), state)
    rest = [replace(step, state=with_facts(step, potato_heated=True)) for step in steps[2:]]
    assert told(start, [*steps[:2], heated, *rest]) == [
        "action 3 heat(['potato'], {}): potato does not stand in a place of the kind 'stove'",
        "action 3 heat(['potato'], {}): potato was not washed before",
    ]


def test_a_fact_that_comes_from_nowhere_is_told(start, steps):
    lines = told(start, changed(steps, 0, state=with_facts(steps[0], potato_heated=True)))
    assert [line.rpartition(": ")[2] for line in lines] == [
        "the state after it says True of 'potato heated', and it should be False",
        "the state after it says False of 'potato heated', and it should be True",
    ]


def test_a_fact_that_is_missing_is_told(start, steps):
    last = replace(steps[4].state, facts={"potato washed": True})
    (line,) = told(start, changed(steps, 4, state=last))
    assert line.endswith(": the state after it says None of 'potato heated', and it should be False")


def test_a_chore_in_which_the_arm_moves_is_told(start, steps):
    here = steps[1].motion.segments[-1]
    still = Motion((replace(here, waypoints=(here.waypoints[-1],) * 2, events=()),))
    assert told(start, changed(steps, 2, motion=still)) == [
        "action 3 wash(['potato'], {}): the arm moves, and has nothing to do here"
    ]


def test_a_place_beside_the_place_that_is_named_is_told(start, steps):
    stove = replace(steps[1].action, objects=("potato", "stove"))
    lines = told(start, changed(steps, 1, action=stove))
    assert [line.rpartition(": ")[2] for line in lines] == ["potato reaches # mm out of stove"]


def test_a_place_elsewhere_is_told(start, steps):
    elsewhere = replace(steps[1].action, params={"x": 0.39, "y": 0.38, "theta": 0.0})
    lines = told(start, changed(steps, 1, action=elsewhere))
    assert [line.rpartition(": ")[2] for line in lines] == ["potato is let go at (#, #), not at (#, #)"]


def test_a_meal_that_is_not_served_is_told(start, steps):
    assert told(start, steps[:3]) == ["potato does not end in a serving place"]
    assert told(start, steps[:4]) == ["potato ends in the gripper"]


def test_a_thing_in_the_way_is_told(start, steps):
    """The plan knows nothing of the bread."""
    instance = replace(MEAL, foods=(POTATO, BREAD))
    poses = {"bread": Pose((*SINK, 0.03))}
    facts = {"bread washed": False, "bread heated": False}

    def with_bread(state):
        return replace(state, poses={**state.poses, **poses}, facts={**state.facts, **facts})

    lines = told(with_bread(start), [replace(step, state=with_bread(step.state)) for step in steps], instance)
    assert any("descend" in line and "potato touches bread" in line for line in lines)
    assert lines[-1] == "bread does not end in a serving place"


def test_actions_that_do_not_exist_do_no_harm(start, steps):
    """The core tells of them."""
    strange = (Action("fly"), Action("pick"), Action("place", ("a",)), Action("wash", ("oil",)), Action("heat"))
    lines = told(start, [PlannedAction(action, Motion(), start) for action in strange])
    assert lines == ["potato was never washed", "potato does not end in a serving place"]


def test_the_clutter_may_end_anywhere(make):
    env = make(KITCHEN)
    state = after(env, env.reset(), pick("oil_bottle"))
    steps = planned(env, env.reset(), pick("oil_bottle"))
    assert steps[-1].state == state
    lines = told(env.reset(), steps, KITCHEN)
    assert not any("oil_bottle" in line for line in lines)
