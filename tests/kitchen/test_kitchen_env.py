"""Preconditions of things and of places, in whole sentences, and what becomes of the state."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from kitchen_world import (
    BOTTLE,
    BREAD,
    CARROT,
    KITCHEN,
    POTATO,
    SERVING,
    SINK,
    STOVE,
    WORKTOP,
    after,
    heat,
    pick,
    place,
    refused,
    wash,
)

from llm3.errors import InstanceError
from llm3.types import Action, FailureKind, Motion, NoMotion, Pose, State
from llm3_kitchen.instance import KitchenInstance
from llm3_kitchen.layout import PLATE_HEIGHT
from llm3_kitchen.meals import PLACES


@pytest.fixture(scope="module")
def env(make):
    return make(KITCHEN)


@pytest.fixture(scope="module")
def start(env):
    return env.reset()


def put(state: State, name: str, spot: tuple[float, float], height: float) -> State:
    """The state with a thing somewhere else, its centre at this height."""
    return replace(state, poses={**state.poses, name: Pose((*spot, height))})


# ---- what has to be true first ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("actions", "sentence"),
    [
        ([pick("sink")], "sink is a place, so you cannot pick it."),
        ([wash("stove")], "stove is a place, so you cannot wash it."),
        ([wash("carrot")], "carrot stands in store, so it cannot be washed: place it in sink first."),
        ([heat("carrot")], "carrot stands in store, so it cannot be heated: place it in stove first."),
        ([wash("oil_bottle")], "oil_bottle is no food, so there is no need to wash it."),
        ([heat("oil_bottle")], "oil_bottle is no food, so there is no need to heat it."),
        ([pick("potato"), wash("potato")], "The gripper holds potato, so it cannot wash potato: put it down first."),
        (
            [pick("bread"), heat("carrot")],
            "The gripper holds bread, so it cannot heat carrot: put bread down first.",
        ),
        (
            [place("potato", "sink", SINK)],
            "The gripper is empty, so it cannot place potato: pick potato first.",
        ),
        (
            [pick("potato"), place("potato", "bread", SINK)],
            "bread is no place: the places are store, sink, stove, worktop, serving.",
        ),
        ([pick("potato"), place("potato", "sink", STOVE)], "At this spot, potato would not be in sink."),
        (
            [pick("potato"), place("potato", "sink", (0.38, 0.447))],
            "At this spot, potato would reach 12 mm out of sink.",
        ),
        (
            [pick("potato"), place("potato", "sink", (0.38, 0.4351))],
            "At this spot, potato would reach 1 mm out of sink.",
        ),
        (
            [pick("potato"), place("potato", "stove", STOVE), heat("potato")],
            "potato is not washed, so it cannot be heated: wash it first.",
        ),
    ],
)
def test_a_precondition_that_is_not_met_is_told_in_a_sentence(env, start, actions, sentence):
    *first, last = actions
    failure = refused(env, after(env, start, *first), last)
    assert failure.kind is FailureKind.PRECONDITION
    assert failure.detail == sentence


def test_food_between_two_places_is_nowhere(env, start):
    state = put(start, "potato", (0.38, 0.30), 0.0225)
    assert refused(env, state, wash("potato")).detail == (
        "potato stands in no place with its whole footprint, so it cannot be washed: place it in sink first."
    )
    assert next(e for e in env.describe(state) if e.name == "potato").properties["stands in"] == "no place"


def test_where_there_is_no_sink_nothing_can_be_washed(make):
    places = tuple(place for place in PLACES if place.kind in ("store", "serving"))
    bare = make(KitchenInstance(places, (BREAD,)))
    assert refused(bare, bare.reset(), wash("bread")).detail == (
        "bread stands in store, so it cannot be washed: there is no sink here."
    )


# ---- what is in the way ----------------------------------------------------------------------------------------------


def test_clutter_keeps_the_hand_from_food_until_it_is_moved(env, start):
    failure = refused(env, start, pick("carrot"))
    assert failure.kind is FailureKind.GOAL_IN_COLLISION
    assert {contact.object for contact in failure.contacts} == {"oil_bottle"}
    state = after(env, start, pick("oil_bottle"), place("oil_bottle", "worktop", WORKTOP), pick("carrot"))
    assert state.held.object == "carrot"


def test_a_place_can_be_full(env, start):
    state = put(start, "bread", SINK, 0.03)
    failure = refused(env, after(env, state, pick("potato")), place("potato", "sink", SINK))
    assert failure.kind is FailureKind.GOAL_IN_COLLISION
    assert "bread" in {contact.object for contact in failure.contacts}


def test_the_rim_of_the_sink_is_in_the_way_of_a_finger(make):
    env = make(KitchenInstance(PLACES, (CARROT,)))
    failure = refused(env, after(env, env.reset(), pick("carrot")), place("carrot", "sink", (0.38, 0.444)))
    assert failure.kind is FailureKind.GOAL_IN_COLLISION
    assert "sink_left" in {contact.object for contact in failure.contacts}


def test_what_is_too_far_away_is_out_of_reach(make):
    far = replace(PLACES[0], name="attic", center=(1.1, 0.0), size=(0.2, 0.2))
    env = make(KitchenInstance((*PLACES, far), (BREAD,)))
    failure = refused(env, after(env, env.reset(), pick("bread")), place("bread", "attic", (1.1, 0.0)))
    assert failure.kind is FailureKind.UNREACHABLE


# ---- what becomes of it ----------------------------------------------------------------------------------------------


def test_washing_and_heating_change_one_fact_and_move_nothing(env, start):
    state = put(start, "potato", SINK, 0.0225)
    assert isinstance(env.prepare(state, wash("potato"), np.random.default_rng(0)), NoMotion)
    washed = env.apply(state, wash("potato"), Motion())
    assert washed.notes == ()
    assert washed.state == replace(state, facts={**state.facts, "potato washed": True})
    on_stove = put(washed.state, "potato", STOVE, PLATE_HEIGHT + 0.0225)
    heated = env.apply(on_stove, heat("potato"), Motion()).state
    assert heated == replace(on_stove, facts={**on_stove.facts, "potato heated": True})


def test_what_is_put_on_the_stove_stands_on_its_plate(env, start):
    state = after(env, start, pick("potato"), place("potato", "stove", STOVE))
    assert state.poses["potato"].position[2] == pytest.approx(PLATE_HEIGHT + 0.0225, abs=0.0005)


def test_what_starts_on_the_stove_stands_on_its_plate(make):
    env = make(KitchenInstance(PLACES, (replace(POTATO, position=STOVE),)))
    assert env.reset().poses["potato"].position[2] == pytest.approx(PLATE_HEIGHT + 0.0225)


def test_a_meal(env, start):
    """The whole of it: from among clutter, over sink and stove, to where it is served."""
    state = start
    left, middle, right = (0.1, 0.56), SERVING, (-0.14, 0.56)
    for actions, unmet in (
        ((), ["carrot is not washed", "carrot is not heated", "carrot is not served", "potato is not washed"]),
        ((pick("oil_bottle"), place("oil_bottle", "worktop", WORKTOP)), ["carrot is not washed"]),
        ((pick("carrot"), place("carrot", "sink", SINK), wash("carrot")), ["carrot is not heated"]),
        ((pick("carrot"), place("carrot", "stove", STOVE), heat("carrot")), ["carrot is not served"]),
        ((pick("carrot"), place("carrot", "serving", left)), ["potato is not washed", "potato is not served"]),
        ((pick("potato"), place("potato", "sink", SINK), wash("potato")), ["potato is not served"]),
        ((pick("potato"), place("potato", "serving", middle)), ["bread is not served"]),
        ((pick("bread"),), ["bread is not served"]),
        ((place("bread", "serving", right),), []),
    ):
        state = after(env, state, *actions)
        status = env.goal(state)
        assert list(status.unmet[: len(unmet)]) == unmet
    assert status.achieved


# ---- what a model is told --------------------------------------------------------------------------------------------


def test_the_state_tells_where_things_are_and_what_is_to_be_done_with_them(env, start):
    told = {entity.name: dict(entity.properties) for entity in env.describe(start)}
    assert list(told) == [*(p.name for p in PLACES), "carrot", "potato", "bread", "oil_bottle"]
    assert told["sink"] == {"kind": "sink", "x range": (0.29, 0.47), "y range": (0.3, 0.46)}
    assert told["carrot"] == {
        "position": (0.6, -0.2, 0.015),
        "size": (0.12, 0.03, 0.03),
        "theta": 0.0,
        "stands in": "store",
        "kind": "food",
        "goal": "washed, heated, served",
        "done": "nothing",
    }
    assert told["bread"]["goal"] == "served"
    assert told["oil_bottle"]["kind"] == "clutter"
    assert "goal" not in told["oil_bottle"]


def test_the_state_tells_what_was_done_and_what_is_held(env, start):
    facts = {**start.facts, "carrot washed": True, "carrot heated": True}
    state = after(env, replace(start, facts=facts), pick("potato"))
    told = {entity.name: dict(entity.properties) for entity in env.describe(state)}
    assert told["carrot"]["done"] == "washed, heated"
    assert told["potato"]["position"] == "in the gripper"
    assert "stands in" not in told["potato"]


def test_things_and_places_are_what_actions_may_take(env):
    assert env.objects == ("carrot", "potato", "bread", BOTTLE.name, "store", "sink", "stove", "worktop", "serving")
    assert [schema.name for schema in env.schemas] == ["pick", "place", "wash", "heat"]
    assert "taken" not in env.task
    assert f"{CARROT.name}" not in env.task


def test_the_answers_do_not_depend_on_what_was_asked_before(make, env, start):
    after(env, start, pick("potato"), place("potato", "sink", SINK), wash("potato"))
    other = make(KITCHEN)
    assert env.reset() == other.reset() == start
    assert refused(env, start, Action("pick", ("carrot",))) == refused(other, start, Action("pick", ("carrot",)))


@pytest.mark.parametrize(
    ("instance", "sentence"),
    [
        (
            replace(KITCHEN, foods=(replace(BREAD, size=(0.2, 0.2, 0.06)),), clutter=()),
            "bread is too wide for the gripper, which takes up to 0.072 m.",
        ),
        (
            replace(KITCHEN, places=(*PLACES[:4], replace(PLACES[4], center=(0.0, 0.0), size=(0.2, 0.2)))),
            "the arm stands on serving: move it farther from the arm.",
        ),
        (
            replace(KITCHEN, places=(*PLACES[:4], replace(PLACES[4], center=(1.2, 1.2)))),
            "serving is out of the arm's reach: move it closer to the arm.",
        ),
        (
            replace(
                KITCHEN,
                places=(replace(PLACES[0], size=(0.9, 0.66)), *PLACES[3:]),
                foods=(replace(BREAD, position=(0.95, 0.0)),),
                clutter=(),
            ),
            "bread starts out of the arm's reach: move it closer to the arm.",
        ),
    ],
)
def test_a_kitchen_in_which_nothing_can_be_served_is_refused(make, instance, sentence):
    with pytest.raises(InstanceError) as error:
        make(instance)
    assert str(error.value) == sentence


def test_clutter_may_be_too_wide_for_the_gripper(make):
    make(replace(KITCHEN, clutter=(replace(BOTTLE, size=(0.1, 0.1, 0.05), position=(0.6, -0.1)),)))
