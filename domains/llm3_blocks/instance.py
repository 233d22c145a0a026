"""One problem of towers, as it stands in an instance file. Lengths in metres, angles in radians."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import combinations
from math import cos, dist, isfinite, sin
from typing import ClassVar

from llm3_bullet.scene import Box, Size
from llm3_bullet.tabletop.box_spec import BoxShape, upright
from llm3_bullet.tabletop.rectangles import Rectangle
from llm3_bullet.tabletop.table import ON_TABLE, TABLE, is_on_table

MOST_BLOCKS = 50
"""A plan of more than 200 actions would not be read, and a block may take four: to the table, and to its tower."""
CLOSE = 0.11
"""Towers of cubes whose middles are at least this far apart, in metres, leave room for fingers, and for the hand if
they are equally high."""


@dataclass(frozen=True)
class BlockSpec(BoxShape):
    """A block: a cube, or any other box."""

    kind: ClassVar[str] = "block"


@dataclass(frozen=True)
class TowerSpec:
    """Blocks that start on top of one another, each on the middle of the one below; a single one, too."""

    blocks: tuple[str, ...]
    """Their names, from the bottom to the top."""
    position: tuple[float, float]
    """x, y of its middle."""
    yaw: float = 0.0
    """Rotation of its blocks about the vertical."""

    def __post_init__(self) -> None:
        if not self.blocks:
            raise ValueError("a tower needs at least one block")
        if not isfinite(self.yaw):
            raise ValueError(f"the yaw of {self} must be a finite number of radians, not {self.yaw}")

    def __str__(self) -> str:
        return f"the tower of {', '.join(self.blocks)}"

    def footprint(self, size: Size) -> Rectangle:
        """What a block of this size covers in it."""
        return Rectangle(self.position, (size[0], size[1]), (cos(self.yaw), sin(self.yaw)))

    def standing(self, sizes: Mapping[str, Size]) -> Iterable[Box]:
        """Its blocks where they start, given the sizes of blocks by name."""
        height = 0.0
        for name in self.blocks:
            size = sizes[name]
            yield Box(name, size, upright(self.position, height + size[2] / 2, self.yaw))
            height += size[2]


@dataclass(frozen=True)
class On:
    """A part of the goal: on(block, below)."""

    block: str
    below: str
    """Another block, or ``table``."""

    def __post_init__(self) -> None:
        if self.block == self.below:
            raise ValueError(f"the goal cannot ask for {self.block} on itself")

    def __str__(self) -> str:
        return f"on({self.block}, {self.below})"


@dataclass(frozen=True)
class BlocksInstance:
    """Which blocks there are, the towers in which they start, and where they belong."""

    blocks: tuple[BlockSpec, ...]
    towers: tuple[TowerSpec, ...]
    goal: tuple[On, ...]

    def __post_init__(self) -> None:
        if not 1 <= len(self.blocks) <= MOST_BLOCKS:
            raise ValueError(f"there must be 1 to {MOST_BLOCKS} blocks, not {len(self.blocks)}")
        names = [block.name for block in self.blocks]
        for name in _twice(names):
            raise ValueError(f"two blocks are called {name}")
        self._check_towers(names)
        self._check_goal(names)

    @property
    def sizes(self) -> dict[str, Size]:
        """Of the blocks, by name."""
        return {block.name: block.size for block in self.blocks}

    @property
    def start(self) -> dict[str, str]:
        """What each block stands on at the start: a block, or ``table``."""
        return {
            name: below
            for tower in self.towers
            for name, below in zip(tower.blocks, (TABLE, *tower.blocks), strict=False)
        }

    @property
    def close(self) -> bool:
        """Whether towers start so close together that the order in which they are taken apart matters."""
        return any(dist(one.position, other.position) < CLOSE for one, other in combinations(self.towers, 2))

    @property
    def to_move(self) -> tuple[str, ...]:
        """The names of the blocks that cannot stay where they start, or stand on such."""
        below = {on.block: on.below for on in self.goal}
        found: list[str] = []
        for tower in self.towers:
            start = dict(zip(tower.blocks, (TABLE, *tower.blocks), strict=False))
            wrong = [below.get(name, start[name]) != start[name] for name in tower.blocks]
            found += tower.blocks[wrong.index(True) :] if any(wrong) else ()
        return tuple(found)

    @property
    def heights(self) -> dict[str, float]:
        """How high the middle of each block of the goal comes at least, by name."""
        below, sizes = {on.block: on.below for on in self.goal}, self.sizes

        def bottom(name: str) -> float:
            under = below.get(name, TABLE)
            return 0.0 if under == TABLE else bottom(under) + sizes[under][2]

        return {name: bottom(name) + sizes[name][2] / 2 for name in below}

    def _check_towers(self, names: list[str]) -> None:
        standing = [name for tower in self.towers for name in tower.blocks]
        _refuse_unknown("a tower holds", standing, names)
        for name in _twice(standing):
            raise ValueError(f"{name} stands in two places")
        for name in names:
            if name not in standing:
                raise ValueError(f"{name} stands in no tower; a block by itself is a tower, too")
        sizes = self.sizes
        areas = [[tower.footprint(sizes[name]) for name in tower.blocks] for tower in self.towers]
        for index, (tower, own) in enumerate(zip(self.towers, areas, strict=True)):
            if not all(map(is_on_table, own)):
                raise ValueError(f"the position of {tower} must be {ON_TABLE}, not {list(tower.position)}")
            for other, others in zip(self.towers[:index], areas[:index], strict=True):
                if any(a.overlaps(b) for a in own for b in others):
                    raise ValueError(f"{other} and {tower} start in one another")

    def _check_goal(self, names: list[str]) -> None:
        if not self.goal:
            raise ValueError("the goal needs at least one part")
        _refuse_unknown("the goal names", [on.block for on in self.goal], names)
        _refuse_unknown("the goal names", [on.below for on in self.goal], [*names, TABLE])
        for name in _twice(on.block for on in self.goal):
            raise ValueError(f"the goal asks for {name} in two places")
        for name in _twice(on.below for on in self.goal if on.below != TABLE):
            raise ValueError(f"the goal asks for two blocks on {name}")
        below = {on.block: on.below for on in self.goal}
        for name in below:
            at, steps = name, 0
            while at in below and steps <= len(below):
                at, steps = below[at], steps + 1
            if steps > len(below):
                raise ValueError(f"the goal puts {name} on top of itself, by way of others")


def _twice(names: Iterable[str]) -> list[str]:
    return [name for name, count in Counter(names).items() if count > 1]


def _refuse_unknown(what: str, used: list[str], known: list[str]) -> None:
    for name in used:
        if name not in known:
            raise ValueError(f"{what} {name!r}, and there is no such block; there are {', '.join(known)}")
