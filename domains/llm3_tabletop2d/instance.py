"""One problem of the plane, as it stands in an instance file."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import cos, hypot, isfinite, sin
from typing import Literal

from llm3.types import ITSELF

Pair = tuple[float, float]
OUTER_WALL = "outer_wall"
"""What stands around the room."""
RESERVED = ("robot", "room", OUTER_WALL, ITSELF)
"""Names that prompts and failures use for what is no object, no wall and no region."""
MOST = 50
"""Objects, walls and regions, each, at most: a prompt tells all of them."""
TOLERANCE = 0.001
"""An outline may reach out of its region by this much, in metres."""
ROOM_SIDE = (0.2, 10.0)
SIDE = (0.01, 5.0)
"""Sides of objects, walls and regions, in metres."""


@dataclass(frozen=True)
class ObjectSpec:
    """A thing that can be moved, and where it starts. Lengths in metres, angles in radians."""

    name: str
    shape: Literal["disc", "box"]
    size: Pair
    """Full side lengths along the object's own x and y; of a disc its diameter, twice."""
    position: Pair
    """x, y of its centre."""
    theta: float = 0.0
    """How far it is turned, counter-clockwise; it stays so, as the robot does not turn."""

    def __post_init__(self) -> None:
        _check_name("object", self.name)
        _check_sides(self.name, self.size)
        _check_numbers(f"the position of {self.name}", self.position)
        _check_numbers(f"the theta of {self.name}", (self.theta,))
        if self.shape == "disc" and self.size[0] != self.size[1]:
            raise ValueError(f"{self.name} is a disc, so both its sizes must be its diameter, not {list(self.size)}")
        if self.shape == "disc" and self.theta:
            raise ValueError(f"{self.name} is a disc, so its theta must be 0, not {self.theta:g}")

    @property
    def outer_radius(self) -> float:
        """Of the smallest circle around its centre that it lies in, in metres."""
        return self.size[0] / 2 if self.shape == "disc" else hypot(*self.size) / 2

    def extent(self, theta: float) -> Pair:
        """How far it reaches along x and y, from end to end, when it is turned so far."""
        if self.shape == "disc":
            return self.size
        c, s, (a, b) = abs(cos(theta)), abs(sin(theta)), self.size
        return c * a + s * b, s * a + c * b


@dataclass(frozen=True)
class RectangleSpec:
    """A wall or a region: a rectangle whose sides are parallel to x and y. Lengths in metres."""

    name: str
    center: Pair
    size: Pair
    """Full side lengths along x and y."""

    def __post_init__(self) -> None:
        _check_name("wall and region", self.name)
        _check_sides(self.name, self.size)
        _check_numbers(f"the center of {self.name}", self.center)

    @property
    def ranges(self) -> tuple[Pair, Pair]:
        """What it covers along x and along y."""
        (x, y), (dx, dy) = self.center, self.size
        return (x - dx / 2, x + dx / 2), (y - dy / 2, y + dy / 2)


@dataclass(frozen=True)
class GoalSpec:
    """Where an object belongs."""

    object: str
    region: str


@dataclass(frozen=True)
class TabletopInstance:
    """What stands where, and what belongs where."""

    room: Pair
    """Its side lengths in metres: x from 0 to the first, y from 0 to the second."""
    robot: Pair
    """x, y of the robot's centre at the start."""
    objects: tuple[ObjectSpec, ...]
    regions: tuple[RectangleSpec, ...]
    goals: tuple[GoalSpec, ...]
    """At least one. An object that has none may stand anywhere at the end."""
    walls: tuple[RectangleSpec, ...] = ()

    def __post_init__(self) -> None:
        low, high = ROOM_SIDE
        if not all(low <= side <= high for side in self.room):
            raise ValueError(f"the sides of the room must be {low:g} to {high:g} m, not {list(self.room)}")
        _check_numbers("the position of the robot", self.robot)
        for kind, count in (
            ("objects", len(self.objects)),
            ("regions", len(self.regions)),
            ("goals", len(self.goals)),
        ):
            if not 1 <= count <= MOST:
                raise ValueError(f"there must be 1 to {MOST} {kind}, not {count}")
        if len(self.walls) > MOST:
            raise ValueError(f"there must be 0 to {MOST} walls, not {len(self.walls)}")
        objects, regions = [o.name for o in self.objects], [r.name for r in self.regions]
        _check_once("things are called", (*objects, *regions, *(wall.name for wall in self.walls)))
        _check_once("goals are for", (goal.object for goal in self.goals))
        for goal in self.goals:
            if goal.object not in objects:
                raise ValueError(f"a goal is for {goal.object!r}, and the objects are {', '.join(objects)}")
            if goal.region not in regions:
                raise ValueError(f"{goal.object} belongs in {goal.region!r}, and the regions are {', '.join(regions)}")
        for region in self.regions:
            if any(a < 0 or b > side for (a, b), side in zip(region.ranges, self.room, strict=True)):
                raise ValueError(f"{region.name} reaches out of the room of {self.room[0]:g} by {self.room[1]:g} m")
        for item in self.objects:
            self._check_room(item)

    def region_of(self, name: str) -> RectangleSpec | None:
        """Where an object belongs; None for one that may stand anywhere."""
        region = next((goal.region for goal in self.goals if goal.object == name), None)
        return next((r for r in self.regions if r.name == region), None)

    def _check_room(self, item: ObjectSpec) -> None:
        region, (x, y) = self.region_of(item.name), item.extent(item.theta)
        if region and (x > region.size[0] + 2 * TOLERANCE or y > region.size[1] + 2 * TOLERANCE):
            raise ValueError(
                f"{item.name} reaches {x:.3g} by {y:.3g} m along x and y, which does not fit into {region.name} of "
                f"{region.size[0]:g} by {region.size[1]:g} m"
            )


def _check_name(kind: str, name: str) -> None:
    if not name.isidentifier():
        raise ValueError(f"{kind} names are letters, digits and underscores, no digit first, not {name!r}")
    if name in RESERVED:
        raise ValueError(f"nothing can be called {name!r}; these names are taken: {', '.join(RESERVED)}")


def _check_sides(name: str, size: Pair) -> None:
    low, high = SIDE
    if not all(low <= side <= high for side in size):
        raise ValueError(f"the sides of {name} must be {low:g} to {high:g} m, not {list(size)}")


def _check_numbers(what: str, values: Iterable[float]) -> None:
    for value in values:
        if not isfinite(value):
            raise ValueError(f"{what} must be finite numbers, not {value}")


def _check_once(what: str, names: Iterable[str]) -> None:
    seen: set[str] = set()
    for name in names:
        if name in seen:
            raise ValueError(f"two {what} {name}")
        seen.add(name)
