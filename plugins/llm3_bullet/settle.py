"""Where boxes come to rest, by physics."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from llm3.types import Pose
from llm3_bullet.clients import BulletClient
from llm3_bullet.poses import as_matrix
from llm3_bullet.scene import Box

NEARLY = 0.001
"""Boxes that are this close count as touching, in metres: poses are rounded, and shapes have a margin."""


@dataclass(frozen=True)
class SettlerSettings:
    """The physics, and what counts as rest."""

    time_step: float = 1 / 240
    """Seconds of a step of the simulation."""
    density: float = 500.0
    """Of the movable boxes, in kg/m³: that of wood."""
    friction: float = 0.7
    """Coulomb coefficient of each surface; a contact has the product of two."""
    linear_speed: float = 1e-3
    """A box slower than this, in m/s, may be at rest."""
    angular_speed: float = 1e-2
    """A box that turns slower than this, in rad/s, may be at rest."""
    steps_at_rest: int = 5
    """For so many steps in a row all boxes must be slow."""
    max_steps: int = 1000
    """Then it ends, wherever the boxes are."""


class Settler:
    """Lets boxes fall in a world of its own, without a robot.

    The world is built anew each time, so the same boxes end in the same poses, to the last bit, whatever fell before:
    no contact, no speed and no solver state survives. It takes about a millisecond.
    """

    def __init__(self, client: BulletClient, settings: SettlerSettings = SettlerSettings()) -> None:
        """Settle in this world, which nothing else may use."""
        self._client = client
        self.settings = settings

    def settle_around(self, name: str, boxes: Iterable[Box]) -> dict[str, Pose]:
        """`settle`, where only one box is let go and the others rest: those that it cannot reach stay as they are."""
        boxes = tuple(boxes)
        concerned = _within_reach(name, tuple(box for box in boxes if not box.fixed))
        settled = self.settle(box for box in boxes if box.fixed or box.name in concerned)
        return {box.name: settled.get(box.name, box.pose) for box in boxes if not box.fixed}

    def settle_without(self, name: str, boxes: Iterable[Box]) -> dict[str, Pose]:
        """`settle`, where one box is taken away and the others rest: those that touched it may fall, and so on."""
        boxes = tuple(boxes)
        (taken,) = (box for box in boxes if box.name == name)
        left = tuple(box for box in boxes if box is not taken)
        movable = tuple(box for box in left if not box.fixed)
        concerned = set().union(*(_within_reach(box.name, movable) for box in movable if _touch(box, taken)))
        settled = self.settle(box for box in left if box.fixed or box.name in concerned) if concerned else {}
        return {box.name: settled.get(box.name, box.pose) for box in movable}

    def settle(self, boxes: Iterable[Box]) -> dict[str, Pose]:
        """Let go of the boxes and wait until they rest.

        A box that is still moving after `max_steps`, such as one that falls past the edge of the world, is reported
        where it is then.

        Args:
            boxes: Fixed and movable ones; their order does not matter.

        Returns:
            The resting poses of the movable boxes, by name.
        """
        boxes = sorted(boxes, key=lambda box: box.name)
        bodies = self._build(boxes)
        movable = [body for box, body in zip(boxes, bodies, strict=True) if not box.fixed]
        slow = 0
        for _ in range(self.settings.max_steps if movable else 0):
            self._client.stepSimulation()
            slow = slow + 1 if all(map(self._is_slow, movable)) else 0
            if slow == self.settings.steps_at_rest:
                break
        return {
            box.name: Pose(*self._client.getBasePositionAndOrientation(body))
            for box, body in zip(boxes, bodies, strict=True)
            if not box.fixed
        }

    def _build(self, boxes: list[Box]) -> list[int]:
        client, settings = self._client, self.settings
        client.resetSimulation()
        client.setPhysicsEngineParameter(fixedTimeStep=settings.time_step, deterministicOverlappingPairs=1)
        client.setGravity(0.0, 0.0, -9.81)
        bodies = []
        for box in boxes:
            shape = client.createCollisionShape(client.GEOM_BOX, halfExtents=[side / 2 for side in box.size])
            mass = 0.0 if box.fixed else settings.density * float(np.prod(box.size))
            body = client.createMultiBody(mass, shape, -1, box.pose.position, box.pose.orientation)
            client.changeDynamics(body, -1, lateralFriction=settings.friction, restitution=0.0)
            bodies.append(int(body))
        return bodies

    def _is_slow(self, body: int) -> bool:
        linear, angular = self._client.getBaseVelocity(body)
        settings = self.settings
        return math.hypot(*linear) < settings.linear_speed and math.hypot(*angular) < settings.angular_speed


def _touch(one: Box, other: Box) -> bool:
    """Whether two boxes touch, or nearly so: whether boxes around them, along the world's axes, do."""
    return all(
        abs(a - b) <= (c + d) / 2 + NEARLY
        for a, b, c, d in zip(one.pose.position, other.pose.position, _extent(one), _extent(other), strict=True)
    )


def _extent(box: Box) -> list[float]:
    extent: list[float] = (np.abs(as_matrix(box.pose)[:3, :3]) @ box.size).tolist()
    return extent


def _within_reach(name: str, boxes: Sequence[Box]) -> set[str]:
    """The box of this name, those that it could touch if it toppled or fell, those that these could, and so on."""
    reached = {name}
    spreading = [box for box in boxes if box.name == name]
    while spreading:
        one = spreading.pop()
        for other in boxes:
            apart = math.dist(one.pose.position, other.pose.position)
            fall = max(0.0, one.pose.position[2] - other.pose.position[2])
            if other.name not in reached and apart <= math.hypot(*one.size) + math.hypot(*other.size) + fall:
                reached.add(other.name)
                spreading.append(other)
    return reached
