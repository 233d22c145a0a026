"""What is wrong with how a problem begins."""

from __future__ import annotations

from itertools import combinations

import numpy as np

from llm3.types import State
from llm3_tabletop2d.bodies import Separation
from llm3_tabletop2d.scene import ROBOT, Scene
from llm3_tabletop2d.ways import CLEARANCE, EXACT, MARGIN

_HERE = np.zeros((1, 2))


def start_fault(scene: Scene, state: State) -> str:
    """A sentence for who made the problem; empty where nothing is wrong.

    Args:
        scene: The bodies.
        state: The initial state.
    """
    standing = scene.standing(state)
    objects = [body for body in standing if body.name in scene.items]
    walls = [body for body in standing if body.name not in scene.items]
    pairs = (*combinations(objects, 2), *((item, wall) for item in objects for wall in walls))
    for first, second in pairs:
        gap = float(Separation((first,), (second,)).gaps(_HERE)[0, 0])
        if gap < MARGIN - EXACT:
            return _closer(first.name, second.name, gap, MARGIN)
    robot = Separation((scene.robot,), standing).gaps(np.array([state.configuration]))[0]
    for (_, other), gap in zip(Separation((scene.robot,), standing).pairs, robot.tolist(), strict=True):
        if gap < CLEARANCE - EXACT:
            return _closer(f"the {ROBOT}", other.name, gap, CLEARANCE)
    return ""


def _closer(first: str, second: str, gap: float, least: float) -> str:
    apart = "touch each other" if gap <= 0 else f"start {gap * 1000:.1f} mm apart"
    return f"{first} and {second} {apart}: leave at least {least * 1000:g} mm between them."
