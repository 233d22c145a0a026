"""A start that differs from the planned one."""

from __future__ import annotations

import numpy as np

from llm3.errors import UsageError
from llm3.types import Noise
from llm3_bullet.execution.world import MotorWorld

TRIES = 100
DEEP = 0.0005
"""Things that are deeper in one another than this, in metres, do not just touch: poses are rounded, and hulls have a
margin."""


def scatter(world: MotorWorld, noise: Noise, rng: np.random.Generator) -> None:
    """Move and turn every movable box a little, in the order of their names.

    A box that would begin in another one, or in the robot, is drawn again; those that are drawn later still stand where
    they are planned.

    Raises:
        UsageError: There is no room for a box, often as it was drawn.
    """
    for name in world.movable if noise.position or noise.angle else ():
        position, orientation = world.frame(name)
        for _ in range(TRIES):
            dx, dy = rng.normal(0.0, noise.position, 2).tolist()
            turn = world.client.getQuaternionFromEuler((0.0, 0.0, float(rng.normal(0.0, noise.angle))))
            _, turned = world.client.multiplyTransforms((0.0, 0.0, 0.0), turn, (0.0, 0.0, 0.0), orientation)
            world.put(name, (position[0] + dx, position[1] + dy, position[2]), turned)
            if world.depth(name) <= DEEP:
                break
        else:
            raise UsageError(
                f"a noise of {noise.position:g} m and {noise.angle:g} rad leaves no room for {name}: it was drawn "
                f"{TRIES} times, each time into something else."
            )
