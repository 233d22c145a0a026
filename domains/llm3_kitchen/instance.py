"""One kitchen problem, as it stands in an instance file. Lengths in metres, angles in radians."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from llm3.types import ITSELF
from llm3_bullet.tabletop.box_spec import BoxSpec, check_boxes
from llm3_bullet.tabletop.rectangles import Rectangle
from llm3_bullet.tabletop.table import ON_TABLE, TABLE, is_on_table

KINDS = ("store", "sink", "stove", "worktop", "serving")
"""What a place can be for."""
MOST_THINGS = 24
"""A plan of more than 200 actions would not be read, and each food takes eight at most."""
RIM = ("front", "back", "right", "left")
"""A sink called `sink` has a rim of which the pieces are called `sink_front` and so on."""
RIM_THICKNESS = 0.008
"""Of the rim around a sink: no other place is so near to it."""
IN_PLACE = 1e-6
"""A footprint that reaches out of a place by no more than this, in metres, is in it: what arithmetic costs."""


@dataclass(frozen=True)
class PlaceSpec:
    """A part of the table on which things stand; its sides are parallel to x and y."""

    name: str
    kind: str
    """One of `KINDS`."""
    center: tuple[float, float]
    size: tuple[float, float]
    """Full side lengths along x and y."""

    def __post_init__(self) -> None:
        if not self.name.isidentifier():
            raise ValueError(
                f"a place's name must be letters, digits and underscores, no digit first, not {self.name!r}"
            )
        if self.name in (TABLE, ITSELF):
            raise ValueError(f"a place cannot be called {self.name!r}; these names are taken: {TABLE}, {ITSELF}")
        if self.kind not in KINDS:
            raise ValueError(f"the kind of {self.name} must be one of {', '.join(KINDS)}, not {self.kind!r}")
        if not all(0.02 <= side <= 2.0 for side in self.size):
            raise ValueError(f"the sides of {self.name} must be 0.02 to 2 m, not {list(self.size)}")
        if not is_on_table(self.area):
            raise ValueError(f"the center of {self.name} must be {ON_TABLE}, not {list(self.center)}")

    @property
    def area(self) -> Rectangle:
        """Where things can stand."""
        return Rectangle(self.center, self.size)

    @property
    def rim(self) -> tuple[str, ...]:
        """The names of the pieces of its rim; none for what has no rim."""
        return tuple(f"{self.name}_{side}" for side in RIM) if self.kind == "sink" else ()

    @property
    def outside(self) -> Rectangle:
        """With the rim, where it has one."""
        rim = RIM_THICKNESS if self.rim else 0.0
        return Rectangle(self.center, (self.size[0] + 2 * rim, self.size[1] + 2 * rim))

    def holds(self, footprint: Rectangle, tolerance: float = IN_PLACE) -> bool:
        """Whether something stands in it with its whole footprint.

        Args:
            footprint: What the thing covers.
            tolerance: How far it may reach out, in metres.
        """
        return self.area.overhang(footprint) <= tolerance


@dataclass(frozen=True)
class FoodSpec(BoxSpec):
    """Food, where it starts, and what is to be done with it before it is served."""

    kind: ClassVar[str] = "food"

    washed: bool = False
    heated: bool = False

    @property
    def needs(self) -> tuple[str, ...]:
        """The kinds of places that it has to be brought to, in this order."""
        washed, heated = self.washed or self.heated, self.heated
        return (*(("sink",) if washed else ()), *(("stove",) if heated else ()), "serving")


@dataclass(frozen=True)
class ClutterSpec(BoxSpec):
    """What is only in the way, and where it starts."""

    kind: ClassVar[str] = "thing"


@dataclass(frozen=True)
class KitchenInstance:
    """The places, the food, and what stands around it."""

    places: tuple[PlaceSpec, ...]
    foods: tuple[FoodSpec, ...]
    clutter: tuple[ClutterSpec, ...] = ()

    def __post_init__(self) -> None:
        if not (self.foods and len(self.things) <= MOST_THINGS):
            raise ValueError(
                f"there must be 1 to {MOST_THINGS} things, one of them food at least, not {len(self.foods)} foods and "
                f"{len(self.clutter)} other things"
            )
        self._check_names()
        self._check_places()
        self._check_things()
        self._check_room()

    @property
    def to_move(self) -> tuple[str, ...]:
        """The names of the foods that do not start where all is done that they need."""
        return tuple(food.name for food in self.foods if not self._is_done_at_start(food))

    @property
    def to_reach(self) -> tuple[str, ...]:
        """The names of the places that some food needs, and for which there is no other."""
        needed = {kind for food in self.foods if not self._is_done_at_start(food) for kind in food.needs}
        kinds = [place.kind for place in self.places]
        return tuple(place.name for place in self.places if place.kind in needed and kinds.count(place.kind) == 1)

    def _is_done_at_start(self, food: FoodSpec) -> bool:
        place = self.place_of(food.footprint)
        return place is not None and food.needs == (place.kind,)

    @property
    def things(self) -> tuple[BoxSpec, ...]:
        """Everything that can be moved."""
        return (*self.foods, *self.clutter)

    def of_kind(self, kind: str) -> tuple[PlaceSpec, ...]:
        """The places that are for something."""
        return tuple(place for place in self.places if place.kind == kind)

    def place_of(self, footprint: Rectangle, tolerance: float = IN_PLACE) -> PlaceSpec | None:
        """Where something stands with its whole footprint; None where it stands in no place, or in part only."""
        return next((place for place in self.places if place.holds(footprint, tolerance)), None)

    def _check_names(self) -> None:
        pieces = (piece for place in self.places for piece in place.rim)
        names = [*(place.name for place in self.places), *(thing.name for thing in self.things), *pieces]
        for index, name in enumerate(names):
            if name in names[:index]:
                raise ValueError(f"two things or places are called {name}")

    def _check_places(self) -> None:
        wanted = {kind for food in self.foods for kind in food.needs}
        for kind in KINDS:
            if kind in wanted and not self.of_kind(kind):
                raise ValueError(f"there must be a place of the kind {kind!r}")
        for index, place in enumerate(self.places):
            for other in self.places[:index]:
                if place.outside.overlaps(other.outside):
                    raise ValueError(f"{other.name} and {place.name} overlap")

    def _check_things(self) -> None:
        for thing in self.things:
            if self.place_of(thing.footprint) is None:
                raise ValueError(
                    f"{thing.name} must start with its whole footprint in one of the places: "
                    f"{', '.join(place.name for place in self.places)}"
                )
        check_boxes(self.things)

    def _check_room(self) -> None:
        for food in self.foods:
            x, y = food.footprint.size
            for kind in food.needs:
                places = self.of_kind(kind)
                if not any(place.area.has_room_for((x, y)) for place in places):
                    there = ", ".join(f"{place.name} {place.size[0]:g} by {place.size[1]:g} m" for place in places)
                    raise ValueError(
                        f"{food.name} fits into no place of the kind {kind!r}: it covers {x:g} by {y:g} m, and {there}"
                    )
        covered = sum(food.footprint.area for food in self.foods)
        room = sum(place.area.area for place in self.of_kind("serving"))
        if covered > room:
            raise ValueError(
                f"the food covers {covered:.4g} m² together, and the places of the kind 'serving' only {room:.4g} m²"
            )
