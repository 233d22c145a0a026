"""How long a path is, and how far from smooth."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.types import Path

QUICK = settings(deadline=None, max_examples=60)
values = st.floats(-3.0, 3.0).map(lambda x: round(x, 3))
points = st.tuples(values, values, values)
waypoints = st.lists(points, min_size=2, max_size=8).map(np.array)


@pytest.mark.parametrize(
    ("corners", "turning"),
    [
        ([[0, 0], [3, 4]], 0.0),
        ([[0, 0], [3, 4], [6, 8]], 0.0),
        ([[0, 0], [1, 0], [1, 1]], np.pi / 2),
        ([[0, 0], [1, 0], [1, 0], [1, 1]], np.pi / 2),  # a standstill turns nothing
        ([[0, 0], [1, 0], [0, 0]], np.pi),
        ([[0, 0], [1, 0], [1, 1], [0, 1], [0, 0]], 3 * np.pi / 2),
        ([[0, 0]], 0.0),
    ],
)
def test_a_path_turns_by_the_angles_between_its_pieces(corners: list[list[float]], turning: float) -> None:
    assert Path(np.array(corners, dtype=float)).turning == pytest.approx(turning)


@given(waypoints)
@QUICK
def test_a_path_turns_as_much_backwards(corners: np.ndarray) -> None:
    assert Path(corners[::-1]).turning == pytest.approx(Path(corners).turning, abs=1e-9)


@given(waypoints, st.floats(0.01, 100.0))
@QUICK
def test_turning_does_not_depend_on_size(corners: np.ndarray, scale: float) -> None:
    assert Path(scale * corners).turning == pytest.approx(Path(corners).turning, abs=1e-6)


@given(waypoints, st.integers(2, 5))
@QUICK
def test_waypoints_on_a_straight_line_change_neither_length_nor_turning(corners: np.ndarray, parts: int) -> None:
    at = np.linspace(0, len(corners) - 1, (len(corners) - 1) * parts + 1)
    finer = np.column_stack([np.interp(at, np.arange(len(corners)), column) for column in corners.T])
    assert Path(finer).length == pytest.approx(Path(corners).length, abs=1e-9)
    assert Path(finer).turning == pytest.approx(Path(corners).turning, abs=1e-6)
