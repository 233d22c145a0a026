from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3_boxpack.instance import TRAY_THICKNESS, BasketSpec
from llm3_boxpack.layout import furniture
from llm3_bullet.tabletop.rectangles import Rectangle
from llm3_bullet.tabletop.table import support_height

BASKET = BasketSpec((0.65, 0.0), (0.22, 0.21))


@pytest.mark.parametrize(
    ("center", "height"),
    [((0.65, 0.0), TRAY_THICKNESS), ((0.39, 0.0), 0.0), ((0.50, 0.0), 0.0), ((0.51, 0.0), TRAY_THICKNESS)],
    ids=["inside", "beside", "just beside", "partly inside"],
)
def test_a_box_stands_on_the_tray_where_it_overlaps_it_and_else_on_the_table(center, height):
    assert support_height((BASKET.floor,), Rectangle(center, (0.07, 0.07))) == height


def test_without_walls_there_are_the_table_and_the_tray():
    table, tray = furniture(BASKET)
    assert (table.name, tray.name) == ("table", "basket")
    assert table.pose.position[2] + table.size[2] / 2 == 0.0
    assert tray.size == (0.22, 0.21, TRAY_THICKNESS)
    assert tray.pose.position == (0.65, 0.0, TRAY_THICKNESS / 2)
    assert table.fixed
    assert tray.fixed


@given(st.floats(0.01, 0.2))
def test_walls_stand_around_the_tray_and_leave_its_inside_free(height):
    walls = furniture(replace(BASKET, walls=round(height, 3)))[2:]
    assert [w.name for w in walls] == [f"basket_wall_{side}" for side in ("front", "back", "right", "left")]
    areas = [Rectangle(w.pose.position[:2], w.size[:2]) for w in walls]
    shrunk = Rectangle(BASKET.center, (BASKET.size[0] - 1e-9, BASKET.size[1] - 1e-9))
    assert not any(area.overlaps(shrunk) for area in areas)
    hull = np.concatenate([area.corners for area in areas])
    assert hull.max(axis=0) == pytest.approx((0.764, 0.109))
    assert hull.min(axis=0) == pytest.approx((0.536, -0.109))
    for wall in walls:
        assert wall.fixed
        assert wall.size[2] == round(height, 3)
        assert wall.pose.position[2] == pytest.approx(wall.size[2] / 2, abs=5.1e-5)  # poses are on a grid of 0.1 mm
