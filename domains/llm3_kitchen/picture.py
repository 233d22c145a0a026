"""What the stand-in has in mind: the kitchen as the prompt shows it, and as its own plan would leave it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, pi, sin

from llm3.types import Action, Context, Entity
from llm3_kitchen.actions import PICK, PLACE

QUARTER = round(pi / 2, 4)
Pair = tuple[float, float]


@dataclass(frozen=True)
class Spot:
    """Where something stands. Lengths in metres."""

    x: float
    y: float
    cover: Pair
    """What it covers along x and y."""


@dataclass(frozen=True)
class Place:
    """A place."""

    kind: str
    x: Pair
    """Its range along x in metres."""
    y: Pair

    def has(self, spot: Spot) -> bool:
        """Whether the middle of something is in it."""
        return self.x[0] <= spot.x <= self.x[1] and self.y[0] <= spot.y <= self.y[1]


@dataclass(frozen=True)
class Thing:
    """Something that can be moved."""

    size: Pair
    """Its horizontal sides in metres."""
    goal: frozenset[str]
    """What is to be done with it, such as ``{"washed", "served"}``; empty for clutter."""


@dataclass(frozen=True)
class Picture:
    """The kitchen at some moment."""

    places: dict[str, Place]
    things: dict[str, Thing]
    spots: dict[str, Spot]
    """Where things stand; the one in the hand is not among them."""
    done: frozenset[tuple[str, str]]
    """The food and what was done with it, such as ``("carrot", "wash")``."""
    held: str | None = None

    def after(self, action: Action) -> Picture:
        """As an action would leave it."""
        name, spots = action.objects[0], dict(self.spots)
        if action.name == PICK.name:
            spots.pop(name, None)
            return replace(self, spots=spots, held=name)
        if action.name == PLACE.name:
            x, y, theta = (action.params[key] for key in ("x", "y", "theta"))
            spots[name] = Spot(x, y, covered(self.things[name].size, theta))
            return replace(self, spots=spots, held=None)
        return replace(self, done=self.done | {(name, action.name)})

    def stands_in(self, name: str, kind: str) -> bool:
        """Whether something stands in a place of a kind."""
        spot = self.spots.get(name)
        return spot is not None and any(place.has(spot) for place in self.places.values() if place.kind == kind)


def picture_of(context: Context) -> Picture:
    """The kitchen as the prompt shows it."""
    entities = {entity.name: entity.properties for entity in context.state}
    places = {
        name: Place(str(shown["kind"]), _pair(shown["x range"]), _pair(shown["y range"]))
        for name, shown in entities.items()
        if "x range" in shown
    }
    others = {name: shown for name, shown in entities.items() if name not in places}
    things = {
        name: Thing(_pair(shown["size"]), frozenset(str(shown.get("goal", "")).split(", ")) - {""})
        for name, shown in others.items()
    }
    standing = (entity for entity in context.state if isinstance(entity.properties.get("position"), tuple))
    spots = {entity.name: _spot(entity) for entity in standing}
    return Picture(places, things, spots, frozenset())


def covered(size: Pair, theta: float) -> Pair:
    """What a rectangle that is turned by theta covers along x and y, in metres."""
    c, s = abs(cos(theta)), abs(sin(theta))
    return c * size[0] + s * size[1], s * size[0] + c * size[1]


def _spot(entity: Entity) -> Spot:
    x, y = _pair(entity.properties["position"])
    theta = entity.properties.get("theta", 0.0)
    return Spot(x, y, covered(_pair(entity.properties["size"]), theta if isinstance(theta, float) else 0.0))


def _pair(property_: object) -> Pair:
    if not isinstance(property_, tuple):
        raise TypeError(f"expected a tuple of numbers, not {property_!r}")
    return property_[0], property_[1]
