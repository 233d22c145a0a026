from __future__ import annotations

import copy
import json
from math import nan

import pytest

from llm3.errors import InputError
from llm3.jsonio import loads
from llm3_blocks.instance import BlocksInstance, BlockSpec, On, TowerSpec

GOOD = {
    "blocks": [
        {"name": "red_block", "size": [0.05, 0.05, 0.05]},
        {"name": "blue_block", "size": [0.05, 0.05, 0.05]},
        {"name": "tan_block", "size": [0.06, 0.06, 0.03]},
    ],
    "towers": [
        {"blocks": ["red_block", "blue_block"], "position": [0.45, 0.1], "yaw": 0.2},
        {"blocks": ["tan_block"], "position": [0.45, -0.1]},
    ],
    "goal": [{"block": "blue_block", "below": "tan_block"}, {"block": "tan_block", "below": "table"}],
}
ON_TABLE = "such that all of it is on the table, x -0.5 to 1.5 m and y -1.5 to 1.5 m"
KNOWN = "there are red_block, blue_block, tan_block"
WRONG = [
    ("blocks.0.name", 7, "Expected `str`, got `int` 7 - at `$.blocks[0].name`"),
    (
        "blocks.0.name",
        "red block",
        "a block's name must be letters, digits and underscores, no digit first, not 'red block' - at `$.blocks[0]`",
    ),
    (
        "blocks.0.name",
        "table",
        "a block cannot be called 'table'; these names are taken: table, itself - at `$.blocks[0]`",
    ),
    (
        "blocks.1.size.2",
        7.0,
        "the sides of blue_block must be 0.005 to 0.5 m, not [0.05, 0.05, 7.0] - at `$.blocks[1]`",
    ),
    ("blocks.0.colour", "red", "unknown field `colour`, expected name, size - at `$.blocks[0]`"),
    ("blocks.1.name", "red_block", "two blocks are called red_block"),
    ("blocks", [], "there must be 1 to 50 blocks, not 0"),
    ("towers.0.blocks", [], "a tower needs at least one block - at `$.towers[0]`"),
    ("towers.0.blocks.1", "puce_block", f"a tower holds 'puce_block', and there is no such block; {KNOWN}"),
    ("towers.1.blocks.0", "red_block", "red_block stands in two places"),
    ("towers.0.blocks", ["red_block"], "blue_block stands in no tower; a block by itself is a tower, too"),
    ("towers.0.position", [0.45], "Expected `array` of length 2, got 1 - at `$.towers[0].position`"),
    (
        "towers.1.position",
        [1.49, 0.0],
        f"the position of the tower of tan_block must be {ON_TABLE}, not [1.49, 0.0]",
    ),
    (
        "towers.1.position",
        [0.45, 0.06],
        "the tower of red_block, blue_block and the tower of tan_block start in one another",
    ),
    ("goal", [], "the goal needs at least one part"),
    ("goal.0.block", "table", f"the goal names 'table', and there is no such block; {KNOWN}"),
    ("goal.0.below", "floor", f"the goal names 'floor', and there is no such block; {KNOWN}, table"),
    ("goal.0.below", "blue_block", "the goal cannot ask for blue_block on itself - at `$.goal[0]`"),
    ("goal.1.block", "blue_block", "the goal asks for blue_block in two places"),
    (
        "goal",
        [{"block": "red_block", "below": "tan_block"}, {"block": "blue_block", "below": "tan_block"}],
        "the goal asks for two blocks on tan_block",
    ),
    (
        "goal",
        [{"block": "red_block", "below": "tan_block"}, {"block": "tan_block", "below": "red_block"}],
        "the goal puts red_block on top of itself, by way of others",
    ),
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
    instance = loads(json.dumps(GOOD), BlocksInstance, "my.json")
    assert instance == BlocksInstance(
        (
            BlockSpec("red_block", (0.05, 0.05, 0.05)),
            BlockSpec("blue_block", (0.05, 0.05, 0.05)),
            BlockSpec("tan_block", (0.06, 0.06, 0.03)),
        ),
        (TowerSpec(("red_block", "blue_block"), (0.45, 0.1), 0.2), TowerSpec(("tan_block",), (0.45, -0.1))),
        (On("blue_block", "tan_block"), On("tan_block", "table")),
    )
    assert instance.start == {"red_block": "table", "blue_block": "red_block", "tan_block": "table"}


@pytest.mark.parametrize(("path", "value", "sentence"), WRONG)
def test_a_wrong_field_gets_one_line_that_names_it(path: str, value: object, sentence: str):
    with pytest.raises(InputError) as error:
        loads(changed(path, value), BlocksInstance, "my.json")
    assert str(error.value) == f"my.json: {sentence}"


def test_a_yaw_that_is_no_number_is_refused():
    with pytest.raises(ValueError) as error:
        TowerSpec(("red_block",), (0.4, 0.0), nan)
    assert str(error.value) == "the yaw of the tower of red_block must be a finite number of radians, not nan"


def test_what_is_above_a_block_that_has_to_be_moved_has_to_be_moved_too():
    cubes = tuple(BlockSpec(name, (0.05, 0.05, 0.05)) for name in ("a", "b", "c", "d"))
    towers = TowerSpec(("a", "b", "c"), (0.5, 0.1)), TowerSpec(("d",), (0.5, -0.1))
    assert BlocksInstance(cubes, towers, (On("b", "d"),)).to_move == ("b", "c")
    assert BlocksInstance(cubes, towers, (On("d", "c"), On("a", "table"))).to_move == ("d",)
    assert BlocksInstance(cubes, towers, (On("b", "a"),)).to_move == ()


def test_a_block_of_the_goal_is_as_high_as_what_is_below_it():
    sizes = {"a": (0.05, 0.05, 0.1), "b": (0.05, 0.05, 0.2), "c": (0.05, 0.05, 0.3)}
    blocks = tuple(BlockSpec(name, size) for name, size in sizes.items())
    towers = tuple(TowerSpec((name,), (0.5, 0.2 * index)) for index, name in enumerate(sizes))
    whole = BlocksInstance(blocks, towers, (On("c", "b"), On("b", "a"), On("a", "table")))
    assert whole.heights == pytest.approx({"a": 0.05, "b": 0.2, "c": 0.45})
    assert BlocksInstance(blocks, towers, (On("c", "b"),)).heights == pytest.approx({"c": 0.35})
