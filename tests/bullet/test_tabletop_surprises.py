from __future__ import annotations

from math import radians

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from llm3.types import Pose
from llm3_bullet.poses import as_matrix
from llm3_bullet.tabletop.stance import stance
from llm3_bullet.tabletop.surprises import surprises

BEFORE = Pose((0.6, 0.1, 0.047))


def pose(x=0.6, y=0.1, z=0.045, turn=0.0, tilt=0.0, about="x") -> Pose:
    rotation = Rotation.from_euler(about, tilt) * Rotation.from_euler("z", turn)
    return Pose((x, y, z), tuple(rotation.as_quat()))


def said(after: Pose, before: Pose = BEFORE) -> tuple[str, ...]:
    return surprises({"red_box": before}, {"red_box": after})


@pytest.mark.parametrize(
    ("after", "sentence"),
    [
        (pose(x=0.608), "red_box slid by 8 mm and is at (0.608, 0.100) now"),
        (pose(x=0.603, y=0.0951), "red_box slid by 6 mm and is at (0.603, 0.095) now"),
        (pose(turn=0.1), "red_box turned by 0.10 rad and is at (0.600, 0.100) now"),
        (pose(turn=-0.1), "red_box turned by -0.10 rad and is at (0.600, 0.100) now"),
        (pose(x=0.61, turn=0.3), "red_box slid by 10 mm and is at (0.610, 0.100) now"),
        (pose(tilt=radians(9)), "red_box leans by 9 degrees and is at (0.600, 0.100) now"),
        (pose(x=0.62, tilt=radians(40), about="y"), "red_box leans by 40 degrees and is at (0.620, 0.100) now"),
        (pose(y=0.16, tilt=radians(90)), "red_box toppled and is at (0.600, 0.160) now"),
        (pose(y=0.16, tilt=radians(180), about="y"), "red_box toppled and is at (0.600, 0.160) now"),
    ],
)
def test_what_physics_did_is_said_in_one_sentence(after: Pose, sentence: str):
    assert said(after) == (sentence,)


@given(st.floats(-0.003, 0.003), st.floats(-0.003, 0.003), st.floats(-0.045, 0.045), st.floats(0.0, radians(4.5)))
def test_small_changes_are_not_worth_a_word(dx, dy, turn, tilt):
    assert said(pose(0.6 + dx, 0.1 + dy, turn=turn, tilt=tilt)) == ()


@given(st.floats(-0.02, 0.02), st.floats(-np.pi, np.pi), st.floats(0.0, np.pi))
def test_what_is_left_unsaid_can_still_be_picked_up(dx, turn, tilt):
    after = pose(0.6 + dx, turn=turn, tilt=tilt)
    assert said(after) or stance(as_matrix(after)[:3, :3], (0.07, 0.07, 0.07)) is not None


def test_a_turn_is_told_relative_to_before():
    assert said(pose(turn=1.3), pose(turn=1.3)) == ()
    assert said(pose(turn=-3.12), pose(turn=3.12)) == ()  # across half a turn


def test_a_box_that_lay_already_has_not_toppled_again():
    assert said(pose(tilt=radians(90)), pose(tilt=radians(90))) == ()


def test_every_box_that_moved_has_its_sentence():
    before = {"red_box": BEFORE, "tan_box": Pose((0.7, 0.0, 0.045)), "blue_box": Pose((0.5, 0.0, 0.045))}
    after = {"red_box": pose(x=0.61), "tan_box": Pose((0.7, 0.0, 0.045)), "blue_box": Pose((0.5, 0.02, 0.045))}
    assert surprises(before, after) == (
        "red_box slid by 10 mm and is at (0.610, 0.100) now",
        "blue_box slid by 20 mm and is at (0.500, 0.020) now",
    )
