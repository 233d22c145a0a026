"""One box-packing problem, as it stands in an instance file."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar

from llm3.types import ITSELF
from llm3_bullet.tabletop import box_spec
from llm3_bullet.tabletop.rectangles import Rectangle
from llm3_bullet.tabletop.table import ON_TABLE, Surface, is_on_table

TRAY_THICKNESS = 0.01
"""Thickness in metres of the plate that is the basket's floor."""
WALLS = ("basket_wall_front", "basket_wall_back", "basket_wall_right", "basket_wall_left")
MAX_WALL_HEIGHT = 0.2
"""Of the upper edge of the basket's walls above the table, in metres."""
TOLERANCE = 0.001
"""A footprint may reach out of the basket by this much, in metres: what a release and rounding can cost."""
MOST_BOXES = 100
"""A plan of more than 200 actions would not be read, and each box takes two."""


@dataclass(frozen=True)
class BoxSpec(box_spec.BoxSpec):
    """A box and where it starts: on whatever is below, the table or the basket."""

    taken: ClassVar[tuple[str, ...]] = ("table", "basket", *WALLS, ITSELF)


@dataclass(frozen=True)
class ClutterSpec(BoxSpec):
    """What is not to be packed and may end anywhere, and where it starts."""

    kind: ClassVar[str] = "thing"


@dataclass(frozen=True)
class BasketSpec:
    """The basket: a flat tray whose sides are parallel to x and y. Lengths in metres."""

    center: tuple[float, float]
    size: tuple[float, float]
    """Full side lengths of its inside along x and y."""
    walls: float = 0.0
    """How high the upper edge of its walls is above the table; 0 for none."""

    def __post_init__(self) -> None:
        if not all(0.02 <= side <= 2.0 for side in self.size):
            raise ValueError(f"the basket's sides must be 0.02 to 2 m, not {list(self.size)}")
        if not 0.0 <= self.walls <= MAX_WALL_HEIGHT:
            raise ValueError(f"the basket's walls must be 0 to {MAX_WALL_HEIGHT:g} m high, not {self.walls:g}")
        if not is_on_table(self.area):
            raise ValueError(f"the basket's center must be {ON_TABLE}, not {list(self.center)}")

    @property
    def area(self) -> Rectangle:
        """Its inside, seen from above."""
        return Rectangle(self.center, self.size)

    @property
    def floor(self) -> Surface:
        """What boxes in it stand on."""
        return Surface(self.area, TRAY_THICKNESS)


@dataclass(frozen=True)
class BoxpackInstance:
    """Which boxes there are, where they start, the basket they belong in, and what is only in the way."""

    basket: BasketSpec
    boxes: tuple[BoxSpec, ...]
    clutter: tuple[ClutterSpec, ...] = ()

    def __post_init__(self) -> None:
        if not 1 <= len(self.boxes) <= MOST_BOXES:
            raise ValueError(f"there must be 1 to {MOST_BOXES} boxes, not {len(self.boxes)}")
        if len(self.things) > MOST_BOXES:
            raise ValueError(f"there must be at most {MOST_BOXES} boxes and other things, not {len(self.things)}")
        for box in self.things:
            if self.basket.area.overlaps(box.footprint) and self.basket.area.overhang(box.footprint) > 0:
                raise ValueError(f"{box.name} starts on the basket's edge; it must be all inside or all outside")
        box_spec.check_boxes(self.things)
        self._check_room()

    @property
    def things(self) -> tuple[BoxSpec, ...]:
        """Everything that can be moved: the boxes, and what is only in the way."""
        return (*self.boxes, *self.clutter)

    def with_walls(self, height: float | None) -> BoxpackInstance:
        """The same with walls of this height around the basket; None leaves them as they are."""
        return self if height is None else replace(self, basket=replace(self.basket, walls=height))

    @property
    def to_move(self) -> tuple[str, ...]:
        """The names of the boxes that start outside of the basket."""
        return tuple(box.name for box in self.boxes if not self.basket.area.overlaps(box.footprint))

    def _check_room(self) -> None:
        basket = self.basket.area
        measures = f"{basket.size[0]:g} by {basket.size[1]:g} m"
        for box in self.boxes:
            x, y = box.footprint.size
            if not basket.has_room_for((x, y), TOLERANCE):
                raise ValueError(
                    f"{box.name} covers {x:g} by {y:g} m, which does not fit into the basket of {measures}"
                )
        covered = sum(box.footprint.area for box in self.boxes)
        if covered > (basket.size[0] + 2 * TOLERANCE) * (basket.size[1] + 2 * TOLERANCE):
            raise ValueError(
                f"the boxes cover {covered:.4g} m² together, which does not fit into the basket of {measures}, "
                f"{basket.area:.4g} m²"
            )
