"""States are rounded, so that equal means equal: the laws of the grid."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.jsonio import dumps, loads
from llm3.types import GoalStatus, Held, Pose, State

lengths = st.floats(-5, 5)
numbers = st.tuples(lengths, lengths, lengths)
quaternions = (
    st.tuples(*[st.floats(-1, 1)] * 4)
    .filter(lambda q: math.hypot(*q) > 0.1)
    .map(lambda q: tuple(c / math.hypot(*q) for c in q))
)
poses = st.builds(Pose, numbers, quaternions)
states = st.builds(
    State,
    poses=st.dictionaries(st.sampled_from(["red_box", "blue_box", "lid"]), poses, max_size=3),
    configuration=st.lists(st.floats(-3.2, 3.2), max_size=7).map(tuple),
    held=st.none() | st.builds(Held, st.just("green_box"), poses),
    facts=st.dictionaries(st.text(max_size=4), st.booleans() | st.integers() | st.text(max_size=4), max_size=3),
)
ON_THE_GRID = st.integers(-50_000, 50_000).map(lambda n: n / 10_000)
WITHIN_A_CELL = st.floats(-0.4e-4, 0.4e-4)


@given(st.tuples(ON_THE_GRID, ON_THE_GRID, ON_THE_GRID), st.tuples(WITHIN_A_CELL, WITHIN_A_CELL, WITHIN_A_CELL))
def test_positions_less_than_half_a_tenth_of_a_millimetre_apart_are_one(position, shift):
    there = Pose(position)
    near = Pose(tuple(p + s for p, s in zip(position, shift, strict=True)))
    assert near == there
    assert hash(near) == hash(there)


@given(st.lists(ON_THE_GRID, min_size=1, max_size=7), WITHIN_A_CELL)
def test_joint_values_less_than_half_a_grid_step_apart_are_one(values, shift):
    there, near = State(configuration=tuple(values)), State(configuration=tuple(v + shift for v in values))
    assert near == there
    assert hash(near) == hash(there)


@given(ON_THE_GRID)
def test_neighbours_on_the_grid_are_two(value):
    assert Pose((value, 0, 0)) != Pose((value + 1e-4, 0, 0))
    assert State(configuration=(value,)) != State(configuration=(value + 1e-4,))


@given(numbers, st.lists(st.floats(-3.2, 3.2), max_size=7))
def test_rounding_moves_a_value_by_half_a_step_at_most(position, configuration):
    state = State({"box": Pose(position)}, tuple(configuration))
    pairs = [*zip(state.poses["box"].position, position, strict=True)]
    pairs += zip(state.configuration, configuration, strict=True)
    assert all(abs(rounded - given) <= 0.5e-4 + 1e-12 for rounded, given in pairs)


@given(quaternions)
def test_the_two_signs_of_a_quaternion_are_one_rotation(quaternion):
    pose, flipped = Pose((0, 0, 0), quaternion), Pose((0, 0, 0), tuple(-c for c in quaternion))
    assert pose == flipped
    assert hash(pose) == hash(flipped)
    assert next(c for c in reversed(pose.orientation) if c) > 0


@given(quaternions)
def test_rounding_keeps_a_rotation_within_a_ten_thousandth_of_a_radian(quaternion):
    kept = Pose((0, 0, 0), quaternion).orientation
    distance = min(math.dist(kept, quaternion), math.dist(kept, [-c for c in quaternion]))
    assert 2 * distance < 1e-4


@given(states)
def test_rounding_twice_is_rounding_once(state):
    again = State(
        {name: Pose(pose.position, pose.orientation) for name, pose in state.poses.items()},
        state.configuration,
        state.held and Held(state.held.object, Pose(state.held.grasp.position, state.held.grasp.orientation)),
        state.facts,
    )
    assert again == state
    assert hash(again) == hash(state)
    assert dumps(again) == dumps(state)


@given(states, st.randoms())
def test_the_order_of_names_does_not_matter(state, random):
    def shuffled(mapping):
        items = list(mapping.items())
        random.shuffle(items)
        return dict(items)

    other = State(shuffled(state.poses), state.configuration, state.held, shuffled(state.facts))
    assert other == state
    assert hash(other) == hash(state)
    assert dumps(other) == dumps(state)


@given(states)
def test_json_gives_a_state_back(state):
    assert loads(dumps(state), State, "a state") == state


def test_minus_zero_is_zero_also_in_writing():
    state = State({"box": Pose((-0.0, -0.00001, 0.0), (-0.0, 0.0, -0.0, -1.0))}, (-0.0, -0.00001))
    assert state == State({"box": Pose((0, 0, 0))}, (0, 0))
    assert "-" not in dumps(state)


def test_a_difference_in_any_field_makes_another_state():
    held = Held("lid", Pose((0, 0, 0.1)))
    everything = [
        State(),
        State({"box": Pose((0, 0, 0))}),
        State(configuration=(0.0,)),
        State(held=held),
        State(held=Held("box", held.grasp)),
        State(facts={"door_open": True}),
        State(facts={"door_open": False}),
    ]
    assert len(set(everything)) == len(everything)


@pytest.mark.parametrize("arguments", [((0, 0),), ((0, 0, 0), (0, 0, 0)), ((0, 0, 0, 1),)])
def test_a_pose_has_seven_numbers(arguments):
    with pytest.raises(ValueError) as caught:
        Pose(*arguments)
    assert str(caught.value) == "a pose has a position of 3 numbers and an orientation of 4 (x, y, z, w)"


@pytest.mark.parametrize(("achieved", "unmet"), [(True, ("the lid is open",)), (False, ())])
def test_a_goal_is_achieved_exactly_if_nothing_is_unmet(achieved, unmet):
    with pytest.raises(ValueError) as caught:
        GoalStatus(achieved, unmet)
    assert str(caught.value) == "a goal is either achieved or has unmet parts: name each of them in `unmet`"


def test_facts_that_are_floats_are_rounded_like_lengths_and_others_are_kept():
    state = State(facts={"level": 0.123456, "drift": -0.00001, "open": True, "count": 3, "place": "sink"})
    assert state.facts == {"level": 0.1235, "drift": 0.0, "open": True, "count": 3, "place": "sink"}
    assert str(state.facts["drift"]) == "0.0"
    assert state.facts["open"] is True


def test_what_is_held_stands_nowhere():
    with pytest.raises(ValueError) as caught:
        State(poses={"lid": Pose((0, 0, 0))}, held=Held("lid", Pose((0, 0, 0.1))))
    assert str(caught.value) == "'lid' is held, so it has no pose of its own: leave it out of `poses`"
