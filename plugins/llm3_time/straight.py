"""From stop to stop along one straight edge."""

from __future__ import annotations

import numpy as np

from llm3_time.piece import Array, Limits, Piece

TICK = 1e-3
"""Seconds. No ramp is shorter: a controller's cycle, below which no motion can be told from a jump."""


def straight(start: Array, end: Array, limits: Limits) -> Piece:
    """The fastest way along an edge: a trapezoid of velocity, or a triangle where the edge is too short for one.

    It is exact in closed form, because on a straight line all joints move in proportion.

    Args:
        start: Where the edge begins, (dof,).
        end: Where it ends, (dof,), somewhere else.
        limits: Of the joints.
    """
    way = end - start
    slow = float(np.max(np.abs(way) / limits.velocity))  # s: what the edge takes at full speed
    hard = float(np.max(np.abs(way) / limits.acceleration))  # s²: of an edge crossed in t, the acceleration is hard/t²
    ramp = max(np.sqrt(hard) if slow**2 <= hard else hard / slow, TICK)
    cruise = max(slow - ramp, 0.0)
    if cruise < TICK:
        ramp, cruise = ramp + cruise, 0.0
    peak = way / (ramp + cruise)
    still = np.zeros_like(way)
    if not cruise:
        halfway = (start + end) / 2
        return Piece(np.array([0.0, ramp, 2 * ramp]), np.array([start, halfway, end]), np.array([still, peak, still]))
    ramped = peak * ramp / 2
    return Piece(
        np.array([0.0, ramp, ramp + cruise, 2 * ramp + cruise]),
        np.array([start, start + ramped, end - ramped, end]),
        np.array([still, peak, peak, still]),
    )
