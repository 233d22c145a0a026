"""JSON in and out: one text for equal values, and one line for whatever is wrong with a file."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Any, Literal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from line_world import LineInstance

from llm3.errors import InputError
from llm3.jsonio import dumps, loads, pretty, read_file, to_builtins
from llm3.types import Action, Failure, FailureKind, FrozenDict, Stats


@dataclass(frozen=True)
class Box:
    name: str
    size: tuple[float, ...]


@dataclass(frozen=True)
class Table:
    height: float
    boxes: tuple[Box, ...] = ()
    by_corner: Mapping[str, Box] = field(default_factory=FrozenDict)
    extra: Any = None

    def __post_init__(self):
        if self.height < 0:
            raise ValueError("height must not be negative,\nas this one is")


class Colour(Enum):
    RED = "red"


boxes = st.builds(Box, st.text(max_size=5), st.lists(st.floats(-9, 9), max_size=3).map(tuple))
tables = st.builds(
    Table,
    st.floats(0, 9),
    st.lists(boxes, max_size=2).map(tuple),
    st.dictionaries(st.text(max_size=3), boxes, max_size=2).map(FrozenDict),
    st.none() | st.text(max_size=3) | st.lists(st.integers(-9, 9), max_size=2),
)
values = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(2**53), 2**53)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=4),
    max_leaves=10,
)


def complaint(text, type_=Table):
    with pytest.raises(InputError) as caught:
        loads(text, type_, "table.json")
    assert "\n" not in str(caught.value)
    return str(caught.value)


# ---- out -----------------------------------------------------------------------------------------------------------


@given(tables)
def test_what_is_written_is_read_back(table):
    assert loads(dumps(table), Table, "a table") == table
    assert loads(pretty(table), Table, "a table") == table
    assert loads(pretty(table).encode(), Table, "a table") == table


@given(values)
def test_one_line_and_the_same_for_equal_values(value):
    text = dumps(value)
    assert "\n" not in text
    assert json.loads(text) == value
    assert dumps(json.loads(text)) == text


@given(tables, st.sampled_from(["boxes", "by_corner", "extra"]))
def test_a_field_left_to_its_default_makes_no_difference(table, left_out):
    given_fields = {name: value for name, value in to_builtins(table).items() if name != left_out}
    read = loads(json.dumps(given_fields), Table, "a table")
    made = replace(table, **{left_out: getattr(Table(0.0), left_out)})
    assert read == made
    assert dumps(read) == dumps(made)


def test_keys_are_sorted_in_one_line_and_in_their_own_order_for_people():
    table = Table(0.5, (Box("b", (1.0,)),))
    assert dumps(table) == '{"boxes":[{"name":"b","size":[1.0]}],"by_corner":{},"extra":null,"height":0.5}'
    assert pretty(Box("b", (1.0, 2.5))) == '{\n  "name": "b",\n  "size": [\n    1.0,\n    2.5\n  ]\n}\n'


def test_the_nouns_and_numpy_have_a_json_form():
    failure = Failure(FailureKind.NO_PATH, objects=("wall",), measures={"error": np.float64(0.5)})
    plain = to_builtins({"failure": failure, "array": np.eye(2), "action": Action("go", (), {"x": 1})})
    assert plain["failure"]["kind"] == "no path within budget"
    assert plain["failure"]["measures"] == {"error": 0.5}
    assert plain["array"] == [[1.0, 0.0], [0.0, 1.0]]
    assert plain["action"] == {"name": "go", "objects": [], "params": {"x": 1.0}}
    assert json.loads(json.dumps(plain)) == plain
    assert loads(dumps(failure), Failure, "a failure") == failure
    assert loads(dumps(Stats(seconds={"plan": 1.5})), Stats, "stats") == Stats(seconds={"plan": 1.5})


@pytest.mark.parametrize("write", [dumps, pretty, to_builtins])
def test_what_has_no_json_form_is_named(write):
    with pytest.raises(TypeError) as caught:
        write({"planner": object()})
    assert str(caught.value) == "object has no JSON form"


# ---- in ------------------------------------------------------------------------------------------------------------

WRONG = {
    "no text": ("", "table.json: empty"),
    "blank": (b"\xef\xbb\xbf\n \n", "table.json: empty"),
    "no JSON": ("height: 1", "table.json: JSON is malformed: invalid character (column 1)"),
    "cut off": ('{"height": 1', "table.json: Input data was truncated"),
    "more than one": ('{"height": 1} 2', "table.json: JSON is malformed: trailing characters (column 16)"),
    "NaN": ('{"height": NaN}', "table.json: JSON is malformed: invalid character (column 12)"),
    "NaN further down": (
        '{\n  "boxes": [],\n  "height": NaN\n}\n',
        "table.json: JSON is malformed: invalid character (line 3, column 13)",
    ),
    "infinity": ('{"height": 1e999}', "table.json: Number out of range - at `$.height`"),
    "a list": ("[1]", "table.json: Expected `object`, got `array`"),
    "missing field": ('{"boxes": []}', "table.json: Object missing required field `height`"),
    "missing field inside": (
        '{"height": 1, "boxes": [{"name": "a"}]}',
        "table.json: Object missing required field `size` - at `$.boxes[0]`",
    ),
    "wrong type": ('{"height": "high"}', 'table.json: Expected `float`, got `str` "high" - at `$.height`'),
    "bool for a number": ('{"height": true}', "table.json: Expected `float`, got `bool` true - at `$.height`"),
    "null for a number": ('{"height": null}', "table.json: Expected `float`, got `null` - at `$.height`"),
    "wrong type inside": (
        '{"height": 1, "boxes": [{"name": "a", "size": [1, "b"]}]}',
        'table.json: Expected `float`, got `str` "b" - at `$.boxes[0].size[1]`',
    ),
    "unknown field": (
        '{"height": 1, "heigth": 2}',
        "table.json: unknown field `heigth`, expected height, boxes, by_corner, extra - at `$`",
    ),
    "unknown field in a list": (
        '{"height": 1, "boxes": [{"name": "a", "size": []}, {"name": "b", "size": [], "mass": 1}]}',
        "table.json: unknown field `mass`, expected name, size - at `$.boxes[1]`",
    ),
    "unknown field in a mapping": (
        '{"height": 1, "by_corner": {"left": {"name": "b", "size": [], "mass": 1}}}',
        "table.json: unknown field `mass`, expected name, size - at `$.by_corner.left`",
    ),
    "unknown field of several lines": (
        '{"height": 1, "a\\nb": 2}',
        "table.json: unknown field `a b`, expected height, boxes, by_corner, extra - at `$`",
    ),
    "refused by the dataclass": ('{"height": -1}', "table.json: height must not be negative, as this one is"),
    "nested too deeply": ("[" * 100_000, "table.json: Expected `object`, got `array`"),
    "nested too deeply inside": ('{"height": 1, "extra": ' + "[" * 100_000, "table.json: nested too deeply"),
    "not UTF-8": (b'{"height": 1, "extra": "\xff"}', "table.json: not UTF-8 text: invalid start byte at byte 24"),
    "half a surrogate pair": ('{"extra": "\ud800"}', "table.json: not UTF-8 text: surrogates not allowed at byte 11"),
    "UTF-16": ("{}".encode("utf-16"), "table.json: not UTF-8 text: invalid start byte at byte 0"),
}


@pytest.mark.parametrize(("text", "sentence"), WRONG.values(), ids=WRONG)
def test_one_line_names_the_source_the_field_and_what_is_wrong(text, sentence):
    assert complaint(text) == sentence


@dataclass(frozen=True)
class Painted:
    """A dataclass with choices in it."""

    parts: tuple[Literal["top", "leg"], ...] = ()
    by_name: dict[str, Colour] = field(default_factory=dict)
    pair: tuple[int, Literal[1, 2]] | None = None


CHOICES = {
    '{"parts": ["top", "arm"]}': "'arm' - at `$.parts[1]`; valid: 'leg', 'top'",
    '{"by_name": {"a": "blue"}}': "'blue' - at `$.by_name[...]`; valid: 'red'",
    '{"pair": [1, 3]}': "3 - at `$.pair[1]`; valid: 1, 2",
}


@pytest.mark.parametrize("text", CHOICES)
def test_the_valid_values_are_told_wherever_they_stand(text):
    assert complaint(text, Painted) == f"table.json: Invalid enum value {CHOICES[text]}"


def test_a_value_that_is_none_of_the_valid_ones_is_named():
    assert complaint('"blue"', Colour) == "table.json: Invalid enum value 'blue'; valid: 'red'"


UNFIT = {
    "cut off after it": ('{"height": "high", ', "Expected `float`, got `str` - at `$.height`"),
    "of some key": (
        '{"by_corner": {"right": {"name": "a", "size": [1]}, "left": 1}, "height": 1}',
        "Expected `object`, got `int` 1 - at `$.by_corner.left`",
    ),
    "below some key": (
        '{"by_corner": {"left": {"name": "b", "size": [1]}, "right": {"name": "a", "size": [1, true]}}, "height": 1}',
        "Expected `float`, got `bool` true - at `$.by_corner.right.size[1]`",
    ),
    "long": (f'{{"height": "{"a" * 99}"}}', f'Expected `float`, got `str` "{"a" * 39}… - at `$.height`'),
    "of several lines": (r'{"height": "a\nb"}', r'Expected `float`, got `str` "a\nb" - at `$.height`'),
    "a list": ('{"height": [1]}', "Expected `float`, got `array` - at `$.height`"),
}


@pytest.mark.parametrize(("text", "sentence"), UNFIT.values(), ids=UNFIT)
def test_a_value_of_another_type_is_quoted_if_it_is_known_and_short(text, sentence):
    assert complaint(text) == f"table.json: {sentence}"


def test_of_a_list_of_another_length_the_length_is_told():
    assert complaint('{"pair": [1]}', Painted) == "table.json: Expected `array` of length 2, got 1 - at `$.pair`"


@given(st.text(st.characters(categories=None)) | st.binary())
def test_no_text_raises_anything_else(text):
    try:
        found = loads(text, Table, "table.json")
    except InputError as error:
        found = str(error)
    assert isinstance(found, Table) or (found.startswith("table.json: ") and "\n" not in found)


def test_what_is_not_checked_further_is_taken_as_it_is():
    assert loads('{"height": 1, "extra": {"anything": [1, {"at": "all"}]}}', Table, "a table").extra == {
        "anything": [1, {"at": "all"}]
    }


# ---- files ---------------------------------------------------------------------------------------------------------


def test_a_file_is_named_in_every_complaint(tmp_path):
    path = tmp_path / "table.json"
    path.write_text('{"height": 1.5}', encoding="utf-8")
    assert read_file(path, Table) == Table(1.5)
    path.write_text('{"height": "high"}', encoding="utf-8")
    with pytest.raises(InputError) as wrong:
        read_file(path, Table)
    assert str(wrong.value) == f'{path}: Expected `float`, got `str` "high" - at `$.height`'
    with pytest.raises(InputError) as absent:
        read_file(tmp_path / "absent.json", Table)
    assert str(absent.value) == f"{tmp_path / 'absent.json'}: No such file or directory"
    with pytest.raises(InputError) as folder:
        read_file(tmp_path, Table)
    assert str(folder.value) == f"{tmp_path}: Is a directory"


def test_a_field_that_stands_there_twice_is_refused(tmp_path):
    path = tmp_path / "twice.json"
    path.write_text('{"start": 1.0, "start": 2.0}', encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_file(path, LineInstance)
    assert str(caught.value) == f"{path}: the field `start` stands there twice"


def test_a_byte_order_mark_does_no_harm(tmp_path):
    path = tmp_path / "mark.json"
    path.write_bytes(b"\xef\xbb\xbf" + b'{"start": 1.0}')
    assert read_file(path, LineInstance) == LineInstance(1.0)
