"""Long blocks in towers so close together that all of them have to be taken apart, and built, in step."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from llm3_blocks.colors import COLORS
from llm3_blocks.instance import BlocksInstance, BlockSpec, On, TowerSpec
from llm3_blocks.solution import Solved, Spot, solution

START = {6: (3, 2, 1), 8: (3, 3, 2), 10: (3, 3, 2, 2)}
"""By the number of blocks, how many of them each tower has at the start, in an order that the seed draws."""
GOAL = {6: (3, 2, 1), 8: (4, 3, 1), 10: (4, 3, 2, 1)}
"""The same for the goal."""
LENGTH, WIDTHS, HEIGHTS = 0.16, (0.05, 0.055, 0.06), (0.04, 0.045, 0.05)
"""Of a block, in metres: fingers take it across, in the middle. Sizes that differ more make towers that creep when
physics looks at them again."""
PLATES, PLATE = ("white_plate", "grey_plate", "black_plate", "silver_plate"), (0.3, 0.094, 0.015)
"""What towers stand on, side by side: too wide for fingers."""
PITCH = 0.1
"""Metres from the middle of a tower to the next: there is room for fingers, but beside a higher tower none for a hand,
nor for a block across."""
STEP = 0.035
"""Metres that one of two neighbours is higher at the start, at least: so the hand has no room at the other one."""
CENTER_X, CENTER_Y = (0.42, 0.5), (-0.02, 0.02)
"""Where the middle of the plates is, in metres."""
CELLS = ((0.22, 0.33), (0.40, 0.33), (0.58, 0.33), (0.10, 0.49), (0.28, 0.49), (0.46, 0.49), (0.10, 0.65))
"""x and y, in metres, to the left of the plates as to their right, of places with room for a block and the hand over
it, whatever is in the others."""
JITTER = 0.004
"""How far a post is from the middle of its cell, in metres, along x and y at most."""
POST = (0.075, 0.075, 0.13)
"""It stands in each cell that the solution does without, too wide for fingers, and higher than where the hand comes."""


def rebuild(count: int, rng: np.random.Generator) -> Solved:
    """A problem of 6, 8 or 10 such blocks."""
    names = tuple(f"{color}_block" for color in COLORS[:count])
    sizes = {name: (LENGTH, float(rng.choice(WIDTHS)), float(rng.choice(HEIGHTS))) for name in names}
    plates = PLATES[: len(START[count])]
    while True:
        start = _towers(names, START[count], plates, rng)
        goal = _towers(names, GOAL[count], plates, rng)
        tops = [sum(sizes[name][2] for name in tower[1:]) for tower in start]
        if _facts(start).isdisjoint(_facts(goal)) and any(abs(a - b) >= STEP for a, b in pairwise(tops)):
            break
    x, y = round(float(rng.uniform(*CENTER_X)), 3), round(float(rng.uniform(*CENTER_Y)), 3)
    middle = (len(plates) - 1) / 2
    towers = [TowerSpec(tower, (x, round(y + (at - middle) * PITCH, 3))) for at, tower in enumerate(start)]
    cells = rng.permutation([(x, side * y) for x, y in CELLS for side in (1, -1)])
    posts = (cells[count:] + rng.uniform(-JITTER, JITTER, (len(cells) - count, 2))).round(3).tolist()
    standing = [TowerSpec((f"post_{at}",), (x, y)) for at, (x, y) in enumerate(posts, start=1)]
    instance = BlocksInstance(
        (
            *(BlockSpec(name, size) for name, size in sizes.items()),
            *(BlockSpec(plate, PLATE) for plate in plates),
            *(BlockSpec(name, POST) for post in standing for name in post.blocks),
        ),
        (*towers, *standing),
        tuple(On(name, below) for name, below in sorted(_facts(goal), key=lambda fact: names.index(fact[0]))),
    )
    return Solved(instance, solution(instance, [Spot(x, y) for x, y in cells[:count].tolist()]))


def _towers(
    names: tuple[str, ...], counts: tuple[int, ...], plates: tuple[str, ...], rng: np.random.Generator
) -> list[tuple[str, ...]]:
    """A plate and blocks for each tower, drawn at random."""
    order = iter(rng.permutation(names).tolist())
    drawn = rng.permutation(counts).tolist()
    return [(plate, *(next(order) for _ in range(count))) for plate, count in zip(plates, drawn, strict=True)]


def _facts(towers: list[tuple[str, ...]]) -> set[tuple[str, str]]:
    """What stands on what."""
    return {(name, below) for tower in towers for below, name in pairwise(tower)}
