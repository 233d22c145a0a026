"""From stop to stop through many waypoints, by TOPP-RA along a spline."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from llm3_time.piece import Array, Limits, Piece
from llm3_time.plotless import import_toppra
from llm3_time.straight import TICK

TOLERANCE = 5e-4
"""How far the motion may be from the edges between the waypoints: Euclidean, in radians, or metres for a sliding
joint. At a robot's reach of 0.85 m that is half a millimetre for one joint; planners keep more clearance."""
MAX_STEP = 1 / 8
"""The longest step of TOPP-RA's grid, as a share of the path: with longer ones the robot would be slower."""
MIN_STEP = 1e-6
"""The shortest: TOPP-RA's tolerances are absolute, and what is shorter drowns in them."""
SAMPLES = np.arange(1, 16) / 16
"""Where in each step the deviation is measured."""


def curved(waypoints: Array, limits: Limits) -> Piece | None:
    """The fastest way through the waypoints without a stop; None if it leaves their edges too far or cannot be found.

    A cubic spline over the chord length is timed by TOPP-RA (Pham & Pham, "A New Approach to Time-Optimal Path
    Parameterization Based on Reachability Analysis", IEEE T-RO 34(3), 2018) on a grid that holds the waypoints. Along
    one step of the grid the acceleration of the path is constant, so positions and velocities at the grid's points are
    all that has to be kept.

    Args:
        waypoints: Shape (N, dof), at least three, each different from the one before.
        limits: Of the joints. The answer may exceed them by a few per cent: see `Piece.excess`.
    """
    toppra = import_toppra()
    chords = np.linalg.norm(np.diff(waypoints, axis=0), axis=1)
    knots = np.concatenate([[0.0], np.cumsum(chords / chords.sum())])
    if np.diff(knots).min() < MIN_STEP:
        return None
    way = toppra.SplineInterpolator(knots, waypoints)
    moved = np.abs(np.diff(waypoints, axis=0)).sum(axis=0)
    slow, hard = float((moved / limits.velocity).max()), float((moved / limits.acceleration).max())
    grid = _grid(knots, max(hard / slow, TICK) / (2 * slow))
    edges = np.searchsorted(knots, grid[:-1], side="right") - 1

    # In a unit of time near the answer every figure is about 1, whatever the limits and the length, as the tolerances
    # demand.
    unit = max(slow, np.sqrt(hard))
    speeds = _speeds(toppra, way, grid, Limits(limits.velocity * unit, limits.acceleration * unit**2))
    if speeds is None or not (speeds[1:] + speeds[:-1] > 0).all():
        return None
    spans = 2 * np.diff(grid) / (speeds[1:] + speeds[:-1]) * unit
    positions = way(grid)
    positions[np.searchsorted(grid, knots)] = waypoints  # to the last digit
    piece = Piece(np.concatenate([[0.0], np.cumsum(spans)]), positions, way(grid, 1) * speeds[:, None] / unit)
    # A joint that rests at the end of its range must not swing beyond it, as splines do.
    piece = piece.within(waypoints.min(axis=0), waypoints.max(axis=0))
    return piece if _deviation(piece, waypoints, edges) <= TOLERANCE else None


def _grid(knots: Array, ramp: float) -> Array:
    """Where the path's acceleration may change: at the waypoints, where ramps end, and in between on long edges.

    Args:
        knots: The parameters of the waypoints, from 0 to 1.
        ramp: Which share of the path it takes to reach full speed.
    """
    ends = np.array([ramp, 1 - ramp] if ramp < MAX_STEP else [])
    apart = np.abs(ends[:, None] - knots).min(axis=1) > ramp / 4
    marks = np.union1d(knots, ends[apart])
    counts = np.ceil(np.diff(marks) / MAX_STEP - 1e-9).astype(int)
    steps = [np.linspace(a, b, count, endpoint=False) for (a, b), count in zip(pairwise(marks), counts, strict=True)]
    return np.concatenate([*steps, marks[-1:]])


def _speeds(toppra: Any, way: Any, grid: Array, limits: Limits) -> Array | None:
    """How fast the path's parameter grows at each point of the grid, (M,), from standstill to standstill."""
    both = [np.column_stack([-limit, limit]) for limit in limits]
    constraints = [
        toppra.constraint.JointVelocityConstraint(both[0]),
        # Limits hold at both ends of a step, and not at its beginning alone: steps can be long.
        toppra.constraint.JointAccelerationConstraint(
            both[1], discretization_scheme=toppra.constraint.DiscretizationType.Interpolation
        ),
    ]
    algorithm = toppra.algorithm.TOPPRA(constraints, way, gridpoints=grid, solver_wrapper="seidel")
    _, speeds, _ = algorithm.compute_parameterization(0, 0)
    return None if speeds is None else np.asarray(speeds)


def _deviation(piece: Piece, waypoints: Array, edges: NDArray[np.signedinteger[Any]]) -> float:
    """How far the motion is from the edge that each step belongs to, at most."""
    points = piece.between(SAMPLES)
    begin = waypoints[edges, None]
    way = waypoints[edges + 1, None] - begin
    fraction = ((points - begin) * way).sum(axis=2, keepdims=True) / (way**2).sum(axis=2, keepdims=True)
    return float(np.linalg.norm(points - begin - np.clip(fraction, 0.0, 1.0) * way, axis=2).max())
