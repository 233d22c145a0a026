"""Families of problems, each with another difficulty; sizes and places are drawn from a seed.

All are solvable by how they are made: what has to be reached has room around it, and doors are wider than what has to
go through.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import pi

import numpy as np

from llm3.seeding import generator
from llm3_tabletop2d.instance import GoalSpec, ObjectSpec, Pair, RectangleSpec, TabletopInstance
from llm3_tabletop2d.scatter import box, disc, scattered, shifted

ROOM: Pair = (1.2, 0.8)
ROBOT_ROOM = 0.05
"""Radius in metres of the free disc around the robot's start, for robots up to 45 mm."""
MIDDLE, THICKNESS = 0.6, 0.04
"""Where the wall with a door is, along x, and how thick, in metres."""

SLACK = 0.05
"""Room in metres that the packed things leave along a side of their tray."""


def generate(setting: str, seed: int) -> TabletopInstance:
    """The instance of a setting and a seed."""
    return SETTINGS[setting](generator("tabletop2d", setting, seed))


def _open(rng: np.random.Generator) -> TabletopInstance:
    """Four things to a tray, with nothing in between."""
    items = [disc("red_disc", rng, 0.06, 0.10), disc("blue_disc", rng, 0.06, 0.10)]
    items += [box(name, rng, (0.05, 0.10), turn=pi / 2) for name in ("green_box", "tan_box")]
    tray = RectangleSpec("tray", (0.95, 0.4), (0.36, 0.56))
    return _with_robot(rng, items, (tray,), "tray", ((0.1, 0.7), (0.1, 0.7)))


def _walls(rng: np.random.Generator) -> TabletopInstance:
    """Two things to the other side of a door through which the robot fits behind them, and not beside them."""
    items = [disc("red_disc", rng, 0.07, 0.09), box("blue_box", rng, (0.06, 0.09))]
    tray = RectangleSpec("tray", (0.98, 0.4), (0.3, 0.4))
    return _with_robot(rng, items, (tray,), "tray", ((0.1, 0.5), (0.1, 0.7)), _door(rng, 0.13))


def _clutter(rng: np.random.Generator) -> TabletopInstance:
    """A thing that nobody asked for stands before the door."""
    walls = _door(rng, 0.13)
    middle = (walls[0].ranges[1][1] + walls[1].ranges[1][0]) / 2
    front = MIDDLE - THICKNESS / 2 - 0.02 - 0.04
    obstacle = ObjectSpec("grey_box", "box", (0.08, 0.15), (round(front, 3), round(middle, 3)))
    items = [disc("red_disc", rng, 0.07, 0.09)]
    tray = RectangleSpec("tray", (0.98, 0.4), (0.3, 0.4))
    return _with_robot(rng, items, (tray,), {"red_disc": "tray"}, ((0.1, 0.42), (0.1, 0.7)), walls, [obstacle])


def _packing(rng: np.random.Generator) -> TabletopInstance:
    """Four things to a tray with three walls that has little room left: what comes first must go to the far end."""
    items = [box("blue_box", rng, (0.09, 0.10)), box("green_box", rng, (0.07, 0.10))]
    items += [disc("red_disc", rng, 0.08, 0.10), disc("yellow_disc", rng, 0.06, 0.09)]
    y = round(float(rng.uniform(0.3, 0.5)), 3)
    (a, b), (c, d) = items[:2], items[2:]  # two behind two others fit in, with the slack between them
    depth = max(a.size[0], b.size[0]) + max(c.size[0], d.size[0]) + SLACK
    width = max(a.size[1] + b.size[1], c.size[1] + d.size[1]) + SLACK
    tray = RectangleSpec("tray", (0.95, y), (round(depth, 3), round(width, 3)))
    t, ((left, right), (low, high)) = 0.03, tray.ranges
    walls = (
        RectangleSpec("back_wall", (right + t / 2, y), (t, high - low + 2 * t)),
        RectangleSpec("upper_wall", ((left + right) / 2, high + t / 2), (right - left, t)),
        RectangleSpec("lower_wall", ((left + right) / 2, low - t / 2), (right - left, t)),
    )
    return _with_robot(rng, items, (tray,), "tray", ((0.1, 0.66), (0.1, 0.7)), walls)


def _push(rng: np.random.Generator) -> TabletopInstance:
    """A box that is too large to be carried, and a disc that is not."""
    size = tuple(round(float(v), 3) for v in rng.uniform(0.16, 0.22, 2))
    y = round(float(rng.uniform(0.3, 0.5)), 3)
    crate = ObjectSpec("brown_box", "box", (size[0], size[1]), (0.4, y))
    yard = RectangleSpec("yard", (0.97, round(float(rng.uniform(0.48, 0.52)), 3)), (0.36, 0.36))
    corner = RectangleSpec("corner", (0.12, 0.68), (0.2, 0.2))
    walls = (
        RectangleSpec("lower_wall", (0.6, 0.05), (0.04, 0.1)),
        RectangleSpec("upper_wall", (0.6, 0.75), (0.04, 0.1)),
    )
    items = [disc("red_disc", rng, 0.06, 0.1)]
    homes = {"brown_box": "yard", "red_disc": "corner"}
    return _with_robot(rng, items, (yard, corner), homes, ((0.7, 1.1), (0.1, 0.2)), walls, [crate])


def _swap(rng: np.random.Generator) -> TabletopInstance:
    """Two things change places; each stands where the other belongs."""
    y = round(float(rng.uniform(0.6, 0.68)), 3)
    x = [round(float(v), 3) for v in (rng.uniform(0.2, 0.45), rng.uniform(0.75, 1.0))]
    bays = tuple(
        RectangleSpec(name, (at, y), (0.14, 0.14)) for name, at in zip(("left_bay", "right_bay"), x, strict=True)
    )
    red, blue = (
        shifted(disc("red_disc", rng, 0.08, 0.1), (x[0], y)),
        shifted(box("blue_box", rng, (0.07, 0.1)), (x[1], y)),
    )
    walls = (RectangleSpec("post", (round(sum(x) / 2, 3), 0.7), (0.04, 0.2)),)
    homes = {"red_disc": "right_bay", "blue_box": "left_bay"}
    return _with_robot(rng, [], bays, homes, ((0.1, 1.1), (0.05, 0.3)), walls, [red, blue])


SETTINGS: dict[str, Callable[[np.random.Generator], TabletopInstance]] = {
    "open": _open,
    "walls": _walls,
    "clutter": _clutter,
    "packing": _packing,
    "push": _push,
    "swap": _swap,
}


def _door(rng: np.random.Generator, width: float) -> tuple[RectangleSpec, RectangleSpec]:
    """A wall from below to above with a door of a width somewhere, as two walls."""
    low = round(float(rng.uniform(0.2, ROOM[1] - 0.2 - width)), 3)
    high = low + width
    return (
        RectangleSpec("lower_wall", (MIDDLE, round(low / 2, 4)), (THICKNESS, low)),
        RectangleSpec("upper_wall", (MIDDLE, round((high + ROOM[1]) / 2, 4)), (THICKNESS, round(ROOM[1] - high, 4))),
    )


def _with_robot(
    rng: np.random.Generator,
    items: Sequence[ObjectSpec],
    regions: tuple[RectangleSpec, ...],
    homes: str | dict[str, str],
    area: tuple[Pair, Pair],
    walls: tuple[RectangleSpec, ...] = (),
    placed: Sequence[ObjectSpec] = (),
) -> TabletopInstance:
    """The instance, with the robot and some of the objects anywhere in an area.

    Args:
        rng: Draws the places.
        items: What is still to be put somewhere.
        regions: Where things belong.
        homes: The region of each object; a text is that of all.
        area: The ranges of x and y in which the items and the robot lie.
        walls: The walls; the area is free of them.
        placed: What has its place.
    """
    robot = ObjectSpec("the_robot", "disc", (2 * ROBOT_ROOM, 2 * ROBOT_ROOM), (0.0, 0.0))
    *put, start = scattered(rng, (*items, robot), area, placed)
    objects = (*put, *placed)
    where = {item.name: homes for item in objects} if isinstance(homes, str) else homes
    goals = tuple(GoalSpec(item.name, where[item.name]) for item in objects if item.name in where)
    return TabletopInstance(ROOM, start.position, objects, regions, goals, walls)
