"""The table as a prompt tells it, for the stand-in."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import cos, sin

from llm3.types import Action, Entity
from llm3_tabletop2d.actions import PICK, PLACE

Span = tuple[float, float]
Area = tuple[Span, Span]
"""What something covers along x and along y, in metres."""


@dataclass(frozen=True)
class Thing:
    """An object. Lengths in metres, angles in radians."""

    name: str
    size: Span
    x: float
    y: float
    theta: float
    region: str | None
    """Where it belongs."""

    @property
    def extent(self) -> Span:
        """How far it reaches along x and y, from end to end."""
        c, s, (a, b) = abs(cos(self.theta)), abs(sin(self.theta)), self.size
        return c * a + s * b, s * a + c * b

    def area_at(self, x: float, y: float) -> Area:
        """What it covers with its centre at (x, y)."""
        dx, dy = self.extent
        return (x - dx / 2, x + dx / 2), (y - dy / 2, y + dy / 2)

    @property
    def area(self) -> Area:
        """What it covers."""
        return self.area_at(self.x, self.y)


@dataclass(frozen=True)
class Table:
    """What stands where."""

    room: Area
    walls: tuple[Area, ...]
    regions: Mapping[str, Area]
    robot: Span
    held: str | None
    things: Mapping[str, Thing]

    def after(self, action: Action) -> Table:
        """The table after an action that works."""
        (name,) = action.objects
        if action.name == PICK:
            return replace(self, held=name)
        x, y = action.params["x"], action.params["y"]
        things = {**self.things, name: replace(self.things[name], x=x, y=y)}
        return replace(self, things=things, held=None if action.name == PLACE else self.held)

    def is_home(self, name: str) -> bool:
        """Whether an object lies where it belongs, or may lie anywhere."""
        thing = self.things[name]
        if thing.region is None:
            return True
        return name != self.held and all(
            low <= a and b <= high for (a, b), (low, high) in zip(thing.area, self.regions[thing.region], strict=True)
        )

    def guests(self, thing: Thing) -> list[Thing]:
        """What else lies in the region of an object and does not belong there."""
        if thing.region is None:
            return []
        others = [t for t in self.things.values() if t.name not in (thing.name, self.held) and t.region != thing.region]
        return [other for other in others if apart(other.area, self.regions[thing.region]) < 0]

    def others(self, thing: Thing) -> list[Area]:
        """What all other objects and the walls cover."""
        return [*self.walls, *(t.area for t in self.things.values() if t.name not in (thing.name, self.held))]


def apart(a: Area, b: Area) -> float:
    """Free space between two areas in metres, along the axis on which there is more of it; negative if they overlap."""
    return max(max(p[0] - q[1], q[0] - p[1]) for p, q in zip(a, b, strict=True))


def table_of(state: Sequence[Entity]) -> Table:
    """The table that the entities of a prompt describe."""
    areas = {e.name: (_span(e, "x range"), _span(e, "y range")) for e in state if "x range" in e.properties}
    things = {e.name: _thing(e) for e in state if "shape" in e.properties}
    robot = next(e for e in state if e.name == "robot")
    regions = {thing.region: areas[thing.region] for thing in things.values() if thing.region}
    holds = str(robot.properties["holds"])
    return Table(
        areas["room"],
        # A region that nothing belongs in looks like a wall here, and to keep off it does no harm.
        tuple(area for name, area in areas.items() if name != "room" and name not in regions),
        regions,
        _span(robot, "position"),
        holds if holds in things else None,
        things,
    )


def _thing(entity: Entity) -> Thing:
    diameter = entity.properties.get("diameter")
    size = (float(diameter), float(diameter)) if isinstance(diameter, (int, float)) else _span(entity, "size")
    x, y = _span(entity, "position")
    region, theta = entity.properties.get("belongs in"), entity.properties.get("theta", 0.0)
    turn = float(theta) if isinstance(theta, (int, float)) else 0.0
    return Thing(entity.name, size, x, y, turn, None if region is None else str(region))


def _span(entity: Entity, name: str) -> Span:
    value = entity.properties[name]
    if not isinstance(value, tuple):
        raise TypeError(f"expected {name} of {entity.name} to be a tuple of numbers, not {value!r}")
    return value[0], value[1]
