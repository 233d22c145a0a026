"""Seeds depend on what they are for, and on nothing else."""

import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.seeding import derive_seed, generator
from llm3.types import Action, Pose, State

STATE = State({"red_box": Pose((0.4, 0.1, 0.035))}, (0.1, -0.2), facts={"open": True, "count": 2})
ACTION = Action("place", ("red_box",), {"y": 0.25, "x": 0.5})
SEED_OF_THESE = 2318161917021929047

parts = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=5) | st.floats(allow_nan=False, allow_infinity=False),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner, max_size=3),
    max_leaves=6,
)


def reordered(value):
    if isinstance(value, dict):
        return {key: reordered(value[key]) for key in reversed(value)}
    return [reordered(item) for item in value] if isinstance(value, list) else value


@given(parts, parts)
def test_a_seed_is_a_function_of_its_parts(one, other):
    seed = derive_seed(one, other)
    assert seed == derive_seed(reordered(one), reordered(other))
    assert 0 <= seed < 2**64


@given(
    st.lists(st.text(max_size=4) | st.integers(), max_size=4), st.lists(st.text(max_size=4) | st.integers(), max_size=4)
)
def test_other_parts_give_another_seed(one, other):
    assert (derive_seed(*one) == derive_seed(*other)) == (one == other)


def test_every_part_of_a_query_counts():
    seeds = {
        derive_seed("plan", 0, STATE, ACTION, 0),
        derive_seed("prepare", 0, STATE, ACTION, 0),
        derive_seed("plan", 1, STATE, ACTION, 0),
        derive_seed("plan", 0, State(), ACTION, 0),
        derive_seed("plan", 0, STATE, Action("place", ("red_box",), {"x": 0.5, "y": 0.2501}), 0),
        derive_seed("plan", 0, STATE, Action("place", ("blue_box",), {"x": 0.5, "y": 0.25}), 0),
        derive_seed("plan", 0, STATE, ACTION, 1),
    }
    assert len(seeds) == 7


def test_the_order_of_parameters_and_facts_does_not_matter():
    same = State(STATE.poses, STATE.configuration, facts={"count": 2, "open": True})
    assert derive_seed(same, Action("place", ("red_box",), {"x": 0.5, "y": 0.25})) == derive_seed(STATE, ACTION)


def test_numbers_of_numpy_count_as_numbers():
    assert derive_seed(np.int64(3), np.float64(0.5), np.array([1.0, 2.0])) == derive_seed(3, 0.5, [1.0, 2.0])


@pytest.mark.parametrize("hash_seed", ["1", "2"])
def test_a_seed_is_the_same_in_every_process_and_version(hash_seed):
    assert derive_seed(STATE, ACTION) == SEED_OF_THESE
    program = (
        "from llm3.seeding import derive_seed; from llm3.types import Action, Pose, State;"
        "print(derive_seed(State({'red_box': Pose((0.4, 0.1, 0.035))}, (0.1, -0.2), facts={'open': True, 'count': 2}),"
        "Action('place', ('red_box',), {'y': 0.25, 'x': 0.5})))"
    )
    surroundings = {**os.environ, "PYTHONHASHSEED": hash_seed, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", program], env=surroundings, capture_output=True, text=True, check=True)
    assert int(done.stdout) == SEED_OF_THESE


@given(parts)
def test_a_generator_starts_anew_each_time(part):
    one, other = generator("plan", part), generator("plan", part)
    first = one.random(3)
    assert (first == other.random(3)).all()
    assert (first == generator("plan", part).random(3)).all()
