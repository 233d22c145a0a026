"""A FrozenDict is a dict that never changes, and can therefore be hashed."""

import copy
import json
import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.types import FrozenDict

dicts = st.dictionaries(st.text(max_size=5), st.integers() | st.text(max_size=3), max_size=5)

CHANGES = {
    "set an item": lambda d: d.__setitem__("a", 2),
    "delete an item": lambda d: d.__delitem__("a"),
    "merge": lambda d: d.__ior__({"b": 1}),
    "clear": lambda d: d.clear(),
    "pop": lambda d: d.pop("a"),
    "pop an item": lambda d: d.popitem(),
    "set a default": lambda d: d.setdefault("b", 1),
    "update": lambda d: d.update(b=1),
}


@given(dicts)
def test_it_equals_the_dict_that_it_was_made_from(plain):
    frozen = FrozenDict(plain)
    assert frozen == plain
    assert list(frozen.items()) == list(plain.items())
    assert isinstance(frozen, dict)


@given(dicts, st.randoms())
def test_equal_ones_hash_alike_whatever_their_order(plain, random):
    items = list(plain.items())
    random.shuffle(items)
    assert hash(FrozenDict(items)) == hash(FrozenDict(plain))


@pytest.mark.parametrize("change", CHANGES.values(), ids=CHANGES)
def test_no_change_is_possible(change):
    frozen = FrozenDict({"a": 1})
    with pytest.raises(TypeError) as caught:
        change(frozen)
    assert str(caught.value) == "a FrozenDict cannot be changed; build a new one"
    assert frozen == {"a": 1}


def test_a_later_change_of_its_source_does_not_reach_it():
    source = {"a": 1}
    frozen = FrozenDict(source)
    source["a"] = 2
    assert frozen == {"a": 1}


def test_what_cannot_be_hashed_inside_cannot_be_hashed_outside():
    with pytest.raises(TypeError, match="unhashable"):
        hash(FrozenDict({"a": []}))


@given(dicts)
def test_copies_are_equal_and_frozen_and_json_takes_it_as_it_is(plain):
    frozen = FrozenDict(plain)
    for copied in (copy.copy(frozen), copy.deepcopy(frozen)):
        assert copied == frozen
        assert hash(copied) == hash(frozen)
    assert json.loads(json.dumps(frozen)) == plain


def test_it_survives_a_trip_to_another_process():
    frozen = FrozenDict({"a": FrozenDict({"b": 1})})
    assert pickle.loads(pickle.dumps(frozen)) == frozen
