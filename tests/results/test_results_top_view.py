"""What a domain shows of itself from above."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.types import Pose, Shape, State

corner = st.tuples(st.floats(-1, 1), st.floats(-1, 1))


def test_an_outline_has_three_corners_that_are_points():
    with pytest.raises(ValueError, match=r"^the outline of box needs at least three corners x, y$"):
        Shape("box", ((0, 0), (1, 1)))
    with pytest.raises(ValueError, match=r"^the outline of box needs at least three corners x, y$"):
        Shape("box", ((0, 0, 0), (1, 1, 0), (1, 0, 0)))
    with pytest.raises(ValueError, match=r"^a corner of box must be finite numbers, not \(0\.0, inf\)$"):
        Shape("box", ((0, 0), (1, 1), (0, float("inf"))))


@pytest.mark.pybullet
def test_box_packing_shows_the_basket_and_the_boxes_where_they_start():
    from llm3_boxpack.domain import BoxPack
    from llm3_boxpack.paper_settings import SETTINGS

    domain = BoxPack()
    for setting in SETTINGS:
        instance = domain.instance(setting, 3)
        state = start(instance)
        basket, *boxes = domain.top_view(instance, {}, state)
        assert (basket.name, basket.fixed) == ("basket", True)
        assert np.allclose(basket.corners, instance.basket.area.corners)
        for shape, box in zip(boxes, instance.boxes, strict=True):
            assert (shape.name, shape.fixed) == (box.name, False)
            assert same_points(shape.corners, box.footprint.corners)


@pytest.mark.pybullet
def test_a_held_box_is_not_shown():
    from llm3_boxpack.domain import BoxPack

    domain = BoxPack()
    instance = domain.instance("medium-small", 0)
    state = start(instance)
    first, *others = (box.name for box in instance.boxes)
    held = State({name: pose for name, pose in state.poses.items() if name != first})
    assert [shape.name for shape in domain.top_view(instance, {}, held)] == ["basket", *others]


@pytest.mark.pybullet
@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(-3, 3))
def test_of_a_box_that_leans_every_corner_lies_in_the_outline(roll, pitch, yaw):
    from scipy.spatial.transform import Rotation

    from llm3_boxpack.domain import BoxPack

    domain = BoxPack()
    instance = domain.instance("hard-small", 0)
    box = instance.boxes[0]
    pose = Pose((0.4, 0.1, 0.2), tuple(Rotation.from_euler("xyz", (roll, pitch, yaw)).as_quat()))
    outline = np.array(domain.top_view(instance, {}, State({box.name: pose}))[1].corners)
    half = np.array(box.size) / 2
    signs = np.array(np.meshgrid(*[(-1, 1)] * 3)).reshape(3, -1).T
    points = (signs * half) @ Rotation.from_quat(pose.orientation).as_matrix().T[:, :2] + pose.position[:2]
    following = np.roll(outline, -1, axis=0)
    for (x, y), (dx, dy) in zip(outline, following - outline, strict=True):  # counter-clockwise: all on the left
        assert (dx * (points[:, 1] - y) - dy * (points[:, 0] - x) > -1e-6).all()


def start(instance):
    return State(
        {b.name: Pose((*b.position, 0.05), (0, 0, np.sin(b.yaw / 2), np.cos(b.yaw / 2))) for b in instance.boxes}
    )


def same_points(one, other):
    distances = np.linalg.norm(np.array(one)[:, None] - np.array(other)[None], axis=2)
    return distances.min(axis=0).max() < 1e-3 and distances.min(axis=1).max() < 1e-3
