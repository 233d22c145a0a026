"""Cubes in low towers, and goals that are one tower or two: the seed draws both, and where they stand."""

from __future__ import annotations

from math import dist

import numpy as np

from llm3_blocks.colors import COLORS
from llm3_blocks.instance import CLOSE, BlocksInstance, BlockSpec, On, TowerSpec
from llm3_blocks.solution import Solved, Spot, solution
from llm3_bullet.tabletop.table import TABLE

SIDE = 0.05
"""Of a cube, in metres."""
START_X, START_Y = (0.45, 0.63), (-0.25, 0.25)
"""Where towers start, in metres: both robots that come with llm3 reach the upper blocks of tall towers there."""
APART = CLOSE
"""Distance in metres between the middles of two towers at the start, at least: the fingers have room beside a tower,
and the hand, if its neighbours are no higher."""
MOST_YAW = 0.5
"""How far towers are turned at the start, in radians."""
SCATTERED = 0.4
"""The share of the seeds with which every block starts on the table."""
TALLEST, MOST_TOWERS = 3, 6
"""Blocks of a tower at the start, and towers there, at most."""
HIGHEST = 6
"""Blocks of a tower of the goal, at most."""
ASIDE = tuple(Spot(x, side * y) for x in (0.14, 0.26, 0.38) for y in (0.41, 0.53) for side in (1, -1))
"""Where the hand has room while towers stand in their part of the table."""
BASES = (Spot(0.5, 0.1), Spot(0.5, -0.1))
"""Where two towers can grow in step when all blocks are aside."""


def cubes(count: int, rng: np.random.Generator) -> Solved:
    """A problem of so many cubes."""
    names = tuple(f"{color}_block" for color in COLORS[:count])
    while True:
        start, goal = _start_towers(names, rng), _goal_towers(names, rng)
        if set(_facts(goal)) - set(_facts(start)):
            break
    positions = _positions(len(start), rng)
    towers = tuple(
        TowerSpec(blocks, position, round(float(rng.uniform(-MOST_YAW, MOST_YAW)), 3))
        for blocks, position in zip(start, positions, strict=True)
    )
    blocks = tuple(BlockSpec(name, (SIDE, SIDE, SIDE)) for name in names)
    instance = BlocksInstance(blocks, towers, _facts(goal))
    return Solved(instance, solution(instance, ASIDE, BASES))


def _start_towers(names: tuple[str, ...], rng: np.random.Generator) -> list[tuple[str, ...]]:
    """Single blocks, or towers that grow at random."""
    scattered = rng.random() < SCATTERED
    towers: list[tuple[str, ...]] = []
    for name in rng.permutation(names).tolist():
        open_ = [index for index, tower in enumerate(towers) if len(tower) < TALLEST]
        if len(towers) < MOST_TOWERS and (scattered or not open_ or rng.random() < 0.5):
            towers.append((name,))
        else:
            index = open_[int(rng.integers(len(open_)))]
            towers[index] = (*towers[index], name)
    return towers


def _goal_towers(names: tuple[str, ...], rng: np.random.Generator) -> list[tuple[str, ...]]:
    """One tower, or two of at least two blocks."""
    order = tuple(rng.permutation(names).tolist())
    if len(order) <= HIGHEST and (len(order) < 4 or rng.random() < 0.5):
        return [order]
    cut = int(rng.integers(max(2, len(order) - HIGHEST), min(len(order) - 2, HIGHEST) + 1))
    return [order[:cut], order[cut:]]


def _facts(towers: list[tuple[str, ...]]) -> tuple[On, ...]:
    return tuple(On(block, below) for tower in towers for block, below in zip(tower, (TABLE, *tower), strict=False))


def _positions(count: int, rng: np.random.Generator) -> list[tuple[float, float]]:
    """So many places, apart from one another."""
    while True:
        drawn = rng.uniform((START_X[0], START_Y[0]), (START_X[1], START_Y[1]), (count, 2)).round(3).tolist()
        places = [(x, y) for x, y in drawn]
        if all(dist(a, b) >= APART for index, a in enumerate(places) for b in places[:index]):
            return places
