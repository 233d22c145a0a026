from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.types import Pose
from llm3_bullet.clients import connect
from llm3_bullet.poses import as_matrix
from llm3_bullet.scene import Box
from llm3_bullet.settle import Settler, SettlerSettings

TABLE = Box("table", (1.2, 2.0, 0.1), Pose((0.5, 0.0, -0.05)), fixed=True)
FLOOR = Box("floor", (6.0, 6.0, 0.1), Pose((0.5, 0.0, -0.75)), fixed=True)
CUBE = (0.07, 0.07, 0.07)
SIZES = ((0.07, 0.07, 0.07), (0.035, 0.035, 0.07), (0.105, 0.035, 0.07), (0.07, 0.07, 0.04))


@pytest.fixture(scope="module")
def settler():
    with connect() as client:
        yield Settler(client)


def turned(yaw: float) -> tuple[float, ...]:
    return (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2))


def standing(name: str, size, x: float, y: float, yaw: float = 0.0, gap: float = 0.0, base: float = 0.0) -> Box:
    return Box(name, size, Pose((x, y, base + size[2] / 2 + gap), turned(yaw)))


def moved(before: Pose, after: Pose) -> np.ndarray:
    return np.subtract(after.position, before.position)


def tilt(pose: Pose) -> float:
    """The angle between the box's z axis and the vertical."""
    return math.acos(min(1.0, as_matrix(pose)[2, 2]))


@st.composite
def rows_of_boxes(draw):
    """Boxes beside each other on the table, far enough apart not to touch."""
    return [
        standing(
            f"box{lane}",
            draw(st.sampled_from(SIZES)),
            draw(st.floats(0.2, 0.8)),
            0.2 * (lane - 2),
            draw(st.floats(-math.pi, math.pi)),
            draw(st.floats(0.0, 0.002)),
        )
        for lane in range(draw(st.integers(1, 5)))
    ]


@settings(max_examples=25, deadline=None)
@given(boxes=rows_of_boxes())
def test_a_box_released_just_above_a_surface_lands_flat_where_it_was(settler, boxes):
    rest = settler.settle([TABLE, *boxes])
    for box in boxes:
        dx, dy, _ = moved(box.pose, rest[box.name])
        assert math.hypot(dx, dy) < 0.0005
        assert abs(rest[box.name].position[2] - box.size[2] / 2) < 0.0002
        assert tilt(rest[box.name]) < 0.002


@settings(max_examples=15, deadline=None)
@given(boxes=rows_of_boxes())
def test_what_rests_does_not_creep(settler, boxes):
    rest = settler.settle([TABLE, *boxes])
    for _ in range(3):
        again = settler.settle([TABLE, *(Box(b.name, b.size, rest[b.name]) for b in boxes)])
        for box in boxes:
            assert np.abs(moved(rest[box.name], again[box.name])).max() <= 0.0001 + 1e-9
        rest = again
    for box in boxes:
        assert math.hypot(*moved(box.pose, rest[box.name])[:2]) < 0.0005


@settings(max_examples=10, deadline=None)
@given(histories=st.lists(st.permutations(range(4)), min_size=2, max_size=3))
def test_the_past_leaves_no_trace(settler, histories):
    worlds = [
        [TABLE, standing("a", SIZES[0], 0.5, 0.0, 0.3, 0.002), standing("b", SIZES[1], 0.5, 0.08, 0.1, 0.002)],
        [TABLE, FLOOR, standing("a", SIZES[0], 1.09, 0.0, 0.0, 0.002)],
        [TABLE, standing("a", SIZES[0], 0.5, 0.0), standing("b", SIZES[0], 0.52, 0.01, 0.4, 0.001, base=0.07)],
        [TABLE, standing("b", SIZES[2], 0.4, 0.3, 1.0, 0.03)],
    ]
    with connect() as client:
        fresh = Settler(client)
        for history in histories:
            for number in history:
                assert settler.settle(worlds[number]) == fresh.settle(worlds[number])


def test_the_past_leaves_no_trace_to_the_last_bit():
    """Poses are rounded; what PyBullet holds behind them must agree too."""

    def bits(client) -> list[tuple[float, ...]]:
        return [
            (*client.getBasePositionAndOrientation(body)[0], *client.getBasePositionAndOrientation(body)[1])
            for body in range(client.getNumBodies())
        ]

    world = [TABLE, standing("a", SIZES[0], 0.5, 0.0, 0.3, 0.05), standing("b", SIZES[1], 0.52, 0.0, 0.1, 0.002)]
    with connect() as one, connect() as other:
        Settler(one).settle(world)
        busy = Settler(other)
        for height in (0.0, 0.01, 0.02):
            busy.settle([TABLE, FLOOR, standing("c", SIZES[2], 1.1, 0.0, 0.7, height)])
        busy.settle(world)
        assert bits(one) == bits(other)


def test_the_order_of_the_boxes_does_not_matter(settler):
    boxes = [
        TABLE,
        standing("a", SIZES[0], 0.5, 0.0, 0.3, 0.02),
        standing("b", SIZES[1], 0.5, 0.04, 0.1, 0.002, base=0.09),
    ]
    assert settler.settle(boxes) == settler.settle(boxes[::-1])


def test_a_box_released_over_an_edge_topples(settler):
    overhanging = standing("a", (0.07, 0.07, 0.07), 1.1 + 0.005, 0.0, gap=0.002)
    rest = settler.settle([TABLE, FLOOR, overhanging])["a"]
    assert rest.position[2] < -0.5


def test_a_box_released_half_over_a_tray_wall_does_not_stay_flat(settler):
    wall = Box("wall", (0.01, 0.2, 0.05), Pose((0.5, 0.0, 0.025)), fixed=True)
    rest = settler.settle([TABLE, wall, standing("a", (0.07, 0.07, 0.07), 0.52, 0.0, gap=0.002, base=0.05)])["a"]
    assert tilt(rest) > 0.1


def test_a_box_rests_on_another_one(settler):
    lower = standing("lower", SIZES[0], 0.5, 0.0, gap=0.001)
    upper = standing("upper", SIZES[1], 0.5, 0.0, gap=0.002, base=0.071)
    rest = settler.settle([TABLE, lower, upper])
    assert abs(rest["upper"].position[2] - 0.105) < 0.0005
    assert tilt(rest["upper"]) < 0.002


def test_a_box_that_falls_out_of_the_world_ends_with_the_steps():
    with connect() as client:
        rest = Settler(client, SettlerSettings(max_steps=24)).settle([standing("a", SIZES[0], 0.0, 0.0)])
    fallen = 0.5 * 9.81 * 0.1**2  # a tenth of a second
    assert rest["a"].position[2] == pytest.approx(0.035 - fallen, abs=0.003)


def test_nothing_movable_is_at_rest_already(settler):
    assert settler.settle([TABLE]) == {}


def test_boxes_that_the_released_one_cannot_reach_stay_as_they_are_to_the_bit(settler):
    near, far = Box("near", CUBE, Pose((0.575, 0.0, 0.035))), Box("far", CUBE, Pose((0.4, -0.4, 0.0352)))
    released = Box("a", CUBE, Pose((0.5, 0.0, 0.037)))
    boxes = (TABLE, released, near, far)
    around, all_ = settler.settle_around("a", boxes), settler.settle(boxes)
    assert set(around) == set(all_) == {"a", "near", "far"}
    assert around["far"] == far.pose
    assert around["a"] == settler.settle((TABLE, released, near))["a"]
    assert abs(around["a"].position[2] - 0.035) < 2e-4


def test_a_box_that_a_reached_one_could_reach_is_settled_too(settler):
    row = [Box(name, CUBE, Pose((0.4 + 0.2 * i, 0.0, 0.045))) for i, name in enumerate("abc")]
    settled = settler.settle_around("a", (TABLE, *row))
    assert all(abs(settled[name].position[2] - 0.035) < 2e-4 for name in "abc")


def test_a_box_may_fall_upon_one_below_an_edge(settler):
    """What is let go high up can land farther away than it could topple."""
    block = Box("block", (0.2, 0.2, 0.3), Pose((0.0, 0.0, 0.15)), fixed=True)
    falling = Box("a", CUBE, Pose((0.11, 0.0, 0.337)))
    below = Box("c", CUBE, Pose((0.28, 0.0, 0.035)))
    boxes = (TABLE, block, falling, below)
    assert settler.settle_around("a", boxes) == settler.settle(boxes)


def test_what_stood_on_a_box_that_is_taken_away_falls(settler):
    below, above = standing("below", CUBE, 0.5, 0.0), standing("above", CUBE, 0.53, 0.0, base=0.07)
    far = standing("far", CUBE, 0.5, 0.6)
    left = settler.settle_without("below", (TABLE, below, above, far))
    assert set(left) == {"above", "far"}
    assert left["far"] == far.pose
    assert abs(left["above"].position[2] - 0.035) < 2e-4


def test_where_nothing_touches_it_a_box_is_taken_without_physics(settler):
    boxes = (TABLE, standing("a", CUBE, 0.5, 0.0), standing("b", CUBE, 0.5, 0.08, base=0.0001))
    assert settler.settle_without("a", boxes) == {"b": boxes[2].pose}
