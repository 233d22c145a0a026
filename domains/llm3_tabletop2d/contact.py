"""Where the robot stands to take hold of something."""

from __future__ import annotations

from math import cos, hypot, sin, sqrt

import numpy as np

from llm3.types import Vector
from llm3_tabletop2d.bodies import Body


def beside(body: Body, angle: float, distance: float) -> Vector:
    """The point that lies in a direction from a body's centre, at a distance from its outline: an offset, (2,).

    Args:
        body: Of which only the shape matters.
        angle: The direction, in radians.
        distance: From the nearest point of the outline, in metres.
    """
    margin = body.radius + distance
    c, s = abs(cos(angle - body.angle)), abs(sin(angle - body.angle))
    a, b = body.sides[0] / 2, body.sides[1] / 2
    # The points at this distance form a rectangle with rounded corners: the ray leaves it by a side or by a corner.
    if c * (b + margin) <= s * a:
        length = (b + margin) / s
    elif s * (a + margin) <= c * b:
        length = (a + margin) / c
    else:
        along = c * a + s * b
        length = along + sqrt(max(0.0, along**2 - hypot(a, b) ** 2 + margin**2))
    return length * np.array((cos(angle), sin(angle)))
