"""The settings: how many blocks. A seed draws the towers at the start, where they stand, and those of the goal."""

from __future__ import annotations

from math import dist

import numpy as np

from llm3.seeding import generator
from llm3_blocks.instance import BlocksInstance, BlockSpec, On, TowerSpec
from llm3_bullet.tabletop.table import TABLE

SIDE = 0.05
"""Of a cube, in metres."""
NAMES = ("red_block", "blue_block", "green_block", "yellow_block", "orange_block", "purple_block")
SETTINGS = tuple(f"blocks-{count}" for count in range(3, len(NAMES) + 1))
START_X, START_Y = (0.45, 0.63), (-0.25, 0.25)
"""Where towers start, in metres: both robots that come with llm3 reach the upper blocks of tall towers there."""
APART = 0.11
"""Distance in metres between the middles of two towers at the start, at least: the fingers have room beside a tower,
and the hand, if its neighbours are no higher."""
MOST_YAW = 0.5
"""How far towers are turned at the start, in radians."""
SCATTERED = 0.4
"""The share of the seeds with which every block starts on the table."""
TALLEST = 3
"""Blocks of a tower at the start, at most."""


def generate(setting: str, seed: int) -> BlocksInstance:
    """The instance of a setting, such as ``"blocks-4"``, and a seed."""
    names = NAMES[: int(setting.rpartition("-")[2])]
    rng = generator("blocks", setting, seed)
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
    return BlocksInstance(blocks, towers, _facts(goal))


def _start_towers(names: tuple[str, ...], rng: np.random.Generator) -> list[tuple[str, ...]]:
    """Single blocks, or towers that grow at random."""
    scattered = rng.random() < SCATTERED
    towers: list[tuple[str, ...]] = []
    for name in rng.permutation(names).tolist():
        open_ = [index for index, tower in enumerate(towers) if len(tower) < TALLEST]
        if scattered or not open_ or rng.random() < 0.5:
            towers.append((name,))
        else:
            index = open_[int(rng.integers(len(open_)))]
            towers[index] = (*towers[index], name)
    return towers


def _goal_towers(names: tuple[str, ...], rng: np.random.Generator) -> list[tuple[str, ...]]:
    """One tower, or two of at least two blocks."""
    order = tuple(rng.permutation(names).tolist())
    if len(order) < 4 or rng.random() < 0.5:
        return [order]
    cut = int(rng.integers(2, len(order) - 1))
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
