from __future__ import annotations

import copy
import json
from math import inf, nan

import pytest

from llm3.errors import InputError
from llm3.jsonio import loads
from llm3_boxpack.instance import BasketSpec, BoxpackInstance, BoxSpec
from llm3_boxpack.layout import furniture

GOOD = {
    "basket": {"center": [0.65, 0.0], "size": [0.22, 0.21]},
    "boxes": [
        {"name": "red_box", "size": [0.07, 0.07, 0.07], "position": [0.39, -0.2], "yaw": 0.0},
        {"name": "blue_box", "size": [0.035, 0.035, 0.07], "position": [0.39, 0.2]},
    ],
}
ON_TABLE = "such that all of it is on the table, x -0.5 to 1.5 m and y -1.5 to 1.5 m"
TAKEN = "table, basket, basket_wall_front, basket_wall_back, basket_wall_right, basket_wall_left, itself"
WRONG = [
    ("boxes.0.name", 7, "Expected `str`, got `int` 7 - at `$.boxes[0].name`"),
    (
        "boxes.0.name",
        "red box",
        "a box's name must be letters, digits and underscores, no digit first, not 'red box' - at `$.boxes[0]`",
    ),
    (
        "boxes.0.name",
        "basket",
        f"a box cannot be called 'basket'; these names are taken: {TAKEN} - at `$.boxes[0]`",
    ),
    ("boxes.0.size", [0.07, 0.07], "Expected `array` of length 3, got 2 - at `$.boxes[0].size`"),
    ("boxes.0.size.1", "wide", 'Expected `float`, got `str` "wide" - at `$.boxes[0].size[1]`'),
    ("boxes.0.size.1", True, "Expected `float`, got `bool` true - at `$.boxes[0].size[1]`"),
    (
        "boxes.0.size.1",
        0.0,
        "the sides of red_box must be 0.005 to 0.5 m, not [0.07, 0.0, 0.07] - at `$.boxes[0]`",
    ),
    (
        "boxes.1.size.2",
        7.0,
        "the sides of blue_box must be 0.005 to 0.5 m, not [0.035, 0.035, 7.0] - at `$.boxes[1]`",
    ),
    ("boxes.0.position", [1.49, 0.0], f"the position of red_box must be {ON_TABLE}, not [1.49, 0.0] - at `$.boxes[0]`"),
    ("boxes.0.position", [0.4], "Expected `array` of length 2, got 1 - at `$.boxes[0].position`"),
    ("boxes.0.yaw", None, "Expected `float`, got `null` - at `$.boxes[0].yaw`"),
    ("boxes.0.colour", "red", "unknown field `colour`, expected name, size, position, yaw - at `$.boxes[0]`"),
    ("boxes.1.name", "red_box", "two things are called red_box"),
    ("boxes.1.position", [0.39, -0.15], "red_box and blue_box start in one another"),
    (
        "boxes.0.size",
        [0.3, 0.1, 0.07],
        "red_box covers 0.3 by 0.1 m, which does not fit into the basket of 0.22 by 0.21 m",
    ),
    (
        "basket.size",
        [0.07, 0.07],
        "the boxes cover 0.006125 m² together, which does not fit into the basket of 0.07 by 0.07 m, 0.0049 m²",
    ),
    ("boxes", [], "there must be 1 to 100 boxes, not 0"),
    ("boxes", {}, "Expected `array`, got `object` - at `$.boxes`"),
    ("basket.size", [0.22, 0.0], "the basket's sides must be 0.02 to 2 m, not [0.22, 0.0] - at `$.basket`"),
    ("basket.center", [3.0, 0.0], f"the basket's center must be {ON_TABLE}, not [3.0, 0.0] - at `$.basket`"),
    ("basket.walls", 0.3, "the basket's walls must be 0 to 0.2 m high, not 0.3 - at `$.basket`"),
    ("basket.walls", -0.1, "the basket's walls must be 0 to 0.2 m high, not -0.1 - at `$.basket`"),
    (
        "clutter",
        [{"name": "red can", "size": [0.05, 0.05, 0.05], "position": [0.5, 0.4]}],
        "a thing's name must be letters, digits and underscores, no digit first, not 'red can' - at `$.clutter[0]`",
    ),
    (
        "clutter",
        [{"name": "red_box", "size": [0.05, 0.05, 0.05], "position": [0.5, 0.4]}],
        "two things are called red_box",
    ),
    (
        "clutter",
        [{"name": "can", "size": [0.05, 0.05, 0.05], "position": [0.39, 0.2]}],
        "blue_box and can start in one another",
    ),
    (
        "clutter",
        [{"name": "can", "size": [0.05, 0.05, 0.05], "position": [0.54, 0.0]}],
        "can starts on the basket's edge; it must be all inside or all outside",
    ),
    (
        "clutter",
        [
            {
                "name": f"can_{i}",
                "size": [0.01, 0.01, 0.01],
                "position": [0.2 + 0.02 * (i % 10), 0.4 + 0.02 * (i // 10)],
            }
            for i in range(99)
        ],
        "there must be at most 100 boxes and other things, not 101",
    ),
    ("basket.depth", 0.1, "unknown field `depth`, expected center, size, walls - at `$.basket`"),
]


def changed(path: str, value: object) -> str:
    data = copy.deepcopy(GOOD)
    *way, last = (int(key) if key.isdigit() else key for key in path.split("."))
    place = data
    for key in way:
        place = place[key]
    place[last] = value
    return json.dumps(data)


def test_a_file_gives_the_instance_and_yaw_may_be_left_out():
    assert loads(json.dumps(GOOD), BoxpackInstance, "my.json") == BoxpackInstance(
        BasketSpec((0.65, 0.0), (0.22, 0.21)),
        (
            BoxSpec("red_box", (0.07, 0.07, 0.07), (0.39, -0.2)),
            BoxSpec("blue_box", (0.035, 0.035, 0.07), (0.39, 0.2)),
        ),
    )


@pytest.mark.parametrize(("path", "value", "sentence"), WRONG)
def test_a_wrong_field_gets_one_line_that_names_it(path: str, value: object, sentence: str):
    with pytest.raises(InputError) as error:
        loads(changed(path, value), BoxpackInstance, "my.json")
    assert str(error.value) == f"my.json: {sentence}"


@pytest.mark.parametrize(
    ("where", "field", "full"),
    [("basket", "center", "$.basket"), ("basket", "size", "$.basket")]
    + [("boxes", field, "$.boxes[0]") for field in ("name", "size", "position")],
)
def test_a_missing_field_gets_one_line_that_names_it(where: str, field: str, full: str):
    data = copy.deepcopy(GOOD)
    del (data[where] if where == "basket" else data[where][0])[field]
    with pytest.raises(InputError) as error:
        loads(json.dumps(data), BoxpackInstance, "my.json")
    assert str(error.value) == f"my.json: Object missing required field `{field}` - at `{full}`"


@pytest.mark.parametrize("field", ["basket", "boxes"])
def test_a_missing_part_gets_one_line_that_names_it(field: str):
    with pytest.raises(InputError) as error:
        loads(json.dumps({k: v for k, v in GOOD.items() if k != field}), BoxpackInstance, "my.json")
    assert str(error.value) == f"my.json: Object missing required field `{field}`"


@pytest.mark.parametrize("yaw", [inf, nan])
def test_a_yaw_that_is_no_number_is_refused(yaw: float):
    with pytest.raises(ValueError) as error:
        BoxSpec("red_box", (0.07, 0.07, 0.07), (0.39, 0.0), yaw)
    assert str(error.value) == f"the yaw of red_box must be a finite number of radians, not {yaw}"


def test_a_position_that_is_no_number_is_refused():
    with pytest.raises(ValueError) as error:
        BoxSpec("red_box", (0.07, 0.07, 0.07), (nan, 0.0))
    assert str(error.value) == f"the position of red_box must be {ON_TABLE}, not [nan, 0.0]"


def test_the_names_that_are_taken_are_those_of_the_furniture():
    names = [thing.name for thing in furniture(BasketSpec((0.65, 0.0), (0.22, 0.21), 0.1))]
    assert [*names, "itself"] == TAKEN.split(", ")


def test_a_box_starts_all_inside_or_all_outside_of_the_basket():
    with pytest.raises(ValueError) as error:
        BoxpackInstance(BasketSpec((0.65, 0.0), (0.22, 0.21)), (BoxSpec("red_box", (0.04, 0.04, 0.06), (0.521, 0.0)),))
    assert str(error.value) == "red_box starts on the basket's edge; it must be all inside or all outside"


def test_a_box_may_lie_slantwise_in_the_basket():
    loads(changed("boxes.0.size", [0.28, 0.01, 0.07]), BoxpackInstance, "my.json")


def test_what_starts_outside_of_the_basket_has_to_be_moved():
    inside = BoxSpec("red_box", (0.07, 0.07, 0.07), (0.65, 0.0))
    outside = BoxSpec("tan_box", (0.07, 0.07, 0.07), (0.39, 0.0))
    assert BoxpackInstance(BasketSpec((0.65, 0.0), (0.22, 0.21)), (inside, outside)).to_move == ("tan_box",)
