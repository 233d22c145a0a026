"""Instance files: what is wrong with one is told in a line that names it."""

from __future__ import annotations

import copy
import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.errors import InputError
from llm3.jsonio import loads, pretty
from llm3_kitchen.domain import Kitchen
from llm3_kitchen.instance import KitchenInstance
from llm3_kitchen.layout import furniture
from llm3_kitchen.meals import PLACES

GOOD = {
    "places": [
        {"name": "shelf", "kind": "store", "center": [0.6, 0.0], "size": [0.24, 0.6]},
        {"name": "basin", "kind": "sink", "center": [0.3, 0.4], "size": [0.2, 0.2]},
        {"name": "hob", "kind": "stove", "center": [0.3, -0.4], "size": [0.2, 0.2]},
        {"name": "tray", "kind": "serving", "center": [0.0, 0.6], "size": [0.2, 0.2]},
    ],
    "foods": [
        {"name": "leek", "size": [0.15, 0.035, 0.035], "position": [0.6, 0.0], "washed": True, "heated": True},
        {"name": "corn", "size": [0.12, 0.04, 0.04], "position": [0.6, 0.1], "yaw": 0.1},
    ],
    "clutter": [{"name": "jar", "size": [0.06, 0.06, 0.1], "position": [0.6, -0.1]}],
}
ON_TABLE = "such that all of it is on the table, x -0.5 to 1.5 m and y -1.5 to 1.5 m"
IN_A_PLACE = "must start with its whole footprint in one of the places: shelf, basin, hob, tray"
WRONG = [
    (
        "places.0.name",
        "the shelf",
        "a place's name must be letters, digits and underscores, no digit first, not 'the shelf' - at `$.places[0]`",
    ),
    (
        "places.0.name",
        "table",
        "a place cannot be called 'table'; these names are taken: table, itself - at `$.places[0]`",
    ),
    (
        "places.1.kind",
        "bath",
        "the kind of basin must be one of store, sink, stove, worktop, serving, not 'bath' - at `$.places[1]`",
    ),
    ("places.1.size", [0.2, 0.0], "the sides of basin must be 0.02 to 2 m, not [0.2, 0.0] - at `$.places[1]`"),
    ("places.1.center", [9.0, 0.0], f"the center of basin must be {ON_TABLE}, not [9.0, 0.0] - at `$.places[1]`"),
    ("places.1.name", "shelf", "two things or places are called shelf"),
    ("places.1.kind", "store", "there must be a place of the kind 'sink'"),
    ("places.2.kind", "store", "there must be a place of the kind 'stove'"),
    ("places.3.kind", "store", "there must be a place of the kind 'serving'"),
    ("places.2.center", [0.3, 0.195], "basin and hob overlap"),
    (
        "places.3.size",
        [0.03, 0.03],
        "leek fits into no place of the kind 'serving': it covers 0.15 by 0.035 m, and tray 0.03 by 0.03 m",
    ),
    (
        "places.1.size",
        [0.1, 0.1],
        "leek fits into no place of the kind 'sink': it covers 0.15 by 0.035 m, and basin 0.1 by 0.1 m",
    ),
    (
        "places.2.size",
        [0.1, 0.1],
        "leek fits into no place of the kind 'stove': it covers 0.15 by 0.035 m, and hob 0.1 by 0.1 m",
    ),
    (
        "places.3.size",
        [0.15, 0.06],
        "the food covers 0.01005 m² together, and the places of the kind 'serving' only 0.009 m²",
    ),
    ("foods", [], "there must be 1 to 24 things, one of them food at least, not 0 foods and 1 other things"),
    (
        "foods.0.name",
        "itself",
        "a food cannot be called 'itself'; these names are taken: table, itself - at `$.foods[0]`",
    ),
    ("foods.0.name", "jar", "two things or places are called jar"),
    ("foods.0.name", "basin_left", "two things or places are called basin_left"),
    ("foods.0.washed", "yes", 'Expected `bool`, got `str` "yes" - at `$.foods[0].washed`'),
    ("foods.0.position", [0.6, 0.07], "leek and corn start in one another"),
    ("foods.0.position", [0.66, 0.0], f"leek {IN_A_PLACE}"),
    ("foods.0.raw", True, "unknown field `raw`, expected name, size, position, yaw, washed, heated - at `$.foods[0]`"),
    (
        "clutter.0.name",
        "",
        "a thing's name must be letters, digits and underscores, no digit first, not '' - at `$.clutter[0]`",
    ),
    (
        "clutter.0.size",
        [0.06, 0.06, 1.0],
        "the sides of jar must be 0.005 to 0.5 m, not [0.06, 0.06, 1.0] - at `$.clutter[0]`",
    ),
    ("clutter.0.position", [0.0, 0.0], f"jar {IN_A_PLACE}"),
]


@settings(max_examples=5)
@given(st.sampled_from(Kitchen.settings), st.integers(0, 10**6))
def test_every_instance_comes_back_from_its_file(setting, seed):
    instance = Kitchen().instance(setting, seed)
    assert loads(pretty(instance), KitchenInstance, "it.json") == instance


def test_yaw_and_what_is_to_be_done_and_clutter_may_be_left_out():
    data = {key: value for key, value in GOOD.items() if key != "clutter"}
    instance = loads(json.dumps(data), KitchenInstance, "my.json")
    assert instance.clutter == ()
    assert [(f.yaw, f.washed, f.heated) for f in instance.foods] == [(0.0, True, True), (0.1, False, False)]


@pytest.mark.parametrize(("path", "value", "sentence"), WRONG)
def test_a_wrong_field_gets_one_line_that_names_it(path: str, value: object, sentence: str):
    data = copy.deepcopy(GOOD)
    *way, last = (int(key) if key.isdigit() else key for key in path.split("."))
    part = data
    for key in way:
        part = part[key]
    part[last] = value
    with pytest.raises(InputError) as error:
        loads(json.dumps(data), KitchenInstance, "my.json")
    assert str(error.value) == f"my.json: {sentence}"


def test_more_than_a_plan_can_serve_is_refused():
    things = [{**GOOD["clutter"][0], "name": f"jar_{i}"} for i in range(23)]
    with pytest.raises(InputError) as error:
        loads(json.dumps({**GOOD, "clutter": things}), KitchenInstance, "my.json")
    sentence = "there must be 1 to 24 things, one of them food at least, not 2 foods and 23 other things"
    assert str(error.value) == f"my.json: {sentence}"


def test_the_pieces_of_a_rim_are_those_of_the_furniture():
    """Failures call them so, and nothing else may be called so."""
    names = {box.name for box in furniture(PLACES)}
    assert names == {"table", "stove", *next(place for place in PLACES if place.kind == "sink").rim}


def test_each_of_several_places_is_told_into_which_food_does_not_fit():
    plate = {"name": "plate", "kind": "serving", "center": [0.0, -0.6], "size": [0.1, 0.05]}
    places = [*GOOD["places"][:3], {**GOOD["places"][3], "size": [0.1, 0.1]}, plate]
    with pytest.raises(InputError) as error:
        loads(json.dumps({**GOOD, "places": places}), KitchenInstance, "my.json")
    assert str(error.value) == (
        "my.json: leek fits into no place of the kind 'serving': it covers 0.15 by 0.035 m, and tray 0.1 by 0.1 m, "
        "plate 0.1 by 0.05 m"
    )


def test_food_that_is_served_at_the_start_and_needs_nothing_else_may_stay():
    served = {"position": [0.0, 0.6], "size": [0.04, 0.04, 0.04]}
    foods = [{**GOOD["foods"][0]}, {**GOOD["foods"][1], **served}]
    instance = loads(json.dumps({**GOOD, "foods": foods}), KitchenInstance, "my.json")
    assert instance.to_move == ("leek",)
    foods[1]["washed"] = True
    assert loads(json.dumps({**GOOD, "foods": foods}), KitchenInstance, "my.json").to_move == ("leek", "corn")
