from __future__ import annotations

from math import pi

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from packing_world import BASKET, CUBE, POST, box, moved, problem, standing
from scipy.spatial.transform import Rotation

from llm3.types import Held, Pose, State
from llm3_boxpack.goal import goal_status
from llm3_boxpack.instance import TOLERANCE

TWO = problem(box("red_box", 0.39, -0.2), box("tan_box", 0.39, 0.2, POST))
PACKED = standing({"red_box": (0.6, 0.0), "tan_box": (0.7, 0.0)})


def unmet(state: State) -> tuple[str, ...]:
    return goal_status(TWO, state).unmet


def test_it_is_reached_when_every_box_lies_in_the_basket():
    assert goal_status(TWO, PACKED).achieved


def test_a_box_beside_the_basket_is_named():
    assert unmet(standing({"red_box": (0.39, 0.0), "tan_box": (0.7, 0.0)}, 0.035)) == ("red_box is not in the basket",)


def test_each_box_has_its_own_sentence():
    assert unmet(standing({"red_box": (0.39, 0.0), "tan_box": (0.755, 0.0)})) == (
        "red_box is not in the basket",
        "tan_box reaches 12 mm out of the basket",
    )


def test_a_held_box_is_not_packed():
    state = State({"red_box": PACKED.poses["red_box"]}, held=Held("tan_box", Pose((0.0, 0.0, 0.0))))
    assert unmet(state) == ("tan_box is still in the gripper",)


@pytest.mark.parametrize("beyond", [0.0, 0.0005, 0.0009])
def test_it_may_reach_out_by_the_tolerance(beyond):
    assert TOLERANCE == 0.001
    assert unmet(standing({"red_box": (0.725 + beyond, 0.07 + beyond), "tan_box": (0.6, 0.0)})) == ()


def test_and_no_farther():
    state = standing({"red_box": (0.6, 0.07), "tan_box": (0.7445, 0.0)})
    assert unmet(state) == ("tan_box reaches 2 mm out of the basket",)


def test_a_toppled_box_counts_with_what_it_covers_now():
    lying = Rotation.from_euler("x", pi / 2).as_matrix()  # a post along y
    assert unmet(moved(PACKED, "tan_box", 0.7, 0.07, 0.0275, lying)) == ()
    assert unmet(moved(PACKED, "tan_box", 0.7, 0.08, 0.0275, lying)) == ("tan_box reaches 10 mm out of the basket",)


def test_a_leaning_box_counts_with_its_shadow():
    leaning = Rotation.from_euler("x", pi / 4).as_matrix()  # 0.035 and 0.07 across the diagonal: 0.0742 along y
    assert unmet(moved(PACKED, "tan_box", 0.7, 0.06, 0.05, leaning)) == ()
    assert unmet(moved(PACKED, "tan_box", 0.7, 0.08, 0.05, leaning)) == ("tan_box reaches 12 mm out of the basket",)


@given(
    st.floats(0.45, 0.85),
    st.floats(-0.2, 0.2),
    st.tuples(st.floats(-pi, pi), st.floats(-pi, pi), st.floats(-pi, pi)),
    st.booleans(),
)
def test_it_agrees_with_the_corners_of_the_box(x, y, turns, upright):
    """The shadow may be larger than what a leaning box covers, never smaller; a box on its base covers its shadow."""
    orientation = Rotation.from_euler("zyx", turns if not upright else (turns[0], 0.0, 0.0)).as_matrix()
    one = problem(box("red_box", 0.39, 0.0, CUBE))
    state = moved(State(), "red_box", x, y, 0.1, orientation)
    corners = np.array(np.meshgrid(*[[-0.5, 0.5]] * 3)).reshape(3, -1).T * CUBE @ orientation.T + (x, y, 0.1)
    out = (np.abs(corners[:, :2] - BASKET.center) - np.array(BASKET.size) / 2).max()
    assume(abs(out - TOLERANCE) > 3e-4)  # poses are rounded
    achieved = goal_status(one, state).achieved
    assert not (achieved and out > TOLERANCE)
    if upright:
        assert achieved == (out <= TOLERANCE)


def test_an_upright_box_reaches_out_as_far_as_its_farthest_corner():
    quarter = Rotation.from_euler("z", pi / 4).as_matrix()
    state = moved(PACKED, "red_box", 0.65, 0.07, 0.045, quarter)
    assert unmet(state) == (f"red_box reaches {(0.07 + 0.035 * 2**0.5 - 0.105) * 1000:.0f} mm out of the basket",)
