from __future__ import annotations

import pytest

from llm3.types import Pose
from llm3_bullet.scene import Box, HeldBox, Scene

POSE = Pose((0.0, 0.0, 0.0))


def test_equal_scenes_are_interchangeable():
    def scene() -> Scene:
        return Scene((Box("a", (1, 2, 3), POSE),), HeldBox("b", (1, 1, 1), POSE), 0.08)

    assert scene() == scene()
    assert len({scene(), scene()}) == 1
    assert scene() != Scene((Box("a", (1, 2, 3), POSE, fixed=True),), scene().held, 0.08)


def test_lists_and_integers_become_tuples_and_floats():
    scene = Scene([Box("a", [1, 2, 3], POSE)])
    assert scene.boxes[0].size == (1.0, 2.0, 3.0)
    assert isinstance(scene.boxes, tuple)
    assert hash(scene) == hash(Scene((Box("a", (1.0, 2.0, 3.0), POSE),)))


@pytest.mark.parametrize("kind", [Box, HeldBox])
@pytest.mark.parametrize("size", [(1.0, 0.0, 1.0), (1.0, -1.0, 1.0), (1.0, 1.0), (1.0, float("nan"), 1.0)])
def test_a_size_is_three_positive_lengths(kind, size):
    with pytest.raises(ValueError) as caught:
        kind("tray", size, POSE)
    assert str(caught.value) == f"the size of 'tray' must be three positive lengths in metres, not {size}"


@pytest.mark.parametrize("held", [True, False])
def test_names_are_unique(held):
    box, other = Box("a", (1, 1, 1), POSE), Box("b", (1, 1, 1), POSE)
    with pytest.raises(ValueError) as caught:
        Scene((other, box), HeldBox("a", (1, 1, 1), POSE)) if held else Scene((other, box, box))
    assert str(caught.value) == "two boxes are called 'a'; the boxes are b, a, a"
