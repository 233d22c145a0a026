"""The collision function that the published LLM3 plans with: pybullet-planning's, for one of our scenes.

It is built as that code builds it: `get_collision_fn` for all movable joints, the fingers among them, with obstacles,
attachments and self-collision, and with every threshold at its default. Two additions favour it: pairs of links that
always touch are disabled, and the gripper may touch what it holds.
"""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import product
from types import ModuleType
from typing import Any

from llm3_bullet.clients import BulletClient, connect, quiet
from llm3_bullet.model import RobotModel
from llm3_bullet.mounting import urdf_file
from llm3_bullet.robot import RobotDescription
from llm3_bullet.scene import Scene, Size

BASE = -1
"""PyBullet's number of a body's base link."""


@dataclass(frozen=True)
class PublishedChecker:
    """One robot among the boxes of one scene, as pybullet-planning sees them."""

    client: BulletClient
    robot: int
    """PyBullet's number of the robot."""
    joints: tuple[int, ...]
    """PyBullet's numbers of the joints that are planned for: the arm's, in the order of a configuration, and then the
    fingers', unless they stand still."""
    fingers: tuple[float, ...]
    """What is appended to a configuration of the arm to have one of `joints`: where the fingers are, in metres."""
    obstacles: tuple[int, ...]
    """PyBullet's numbers of the scene's boxes, in the scene's order."""
    attachments: tuple[Any, ...]
    """pybullet-planning's attachment of the held box; empty without one."""
    limits: Mapping[int, tuple[float, float]]
    """Limits by joint, what pybullet-planning calls ``custom_limits``."""
    collides: Callable[[Sequence[float]], bool]
    """pybullet-planning's ``collision_fn``: whether a configuration of `joints` collides or is out of its limits."""


def pybullet_planning() -> ModuleType:
    """The package, imported without its banner and without its deprecation warnings."""
    with quiet(), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import pybullet_planning
    return pybullet_planning


@contextmanager
def published_checker(
    description: RobotDescription, scene: Scene, plan_fingers: bool = True
) -> Iterator[PublishedChecker]:
    """Set the checker up in a client of its own, which is gone after the block.

    pybullet-planning talks to one client at a time: of several checkers, only the one that was made last works.

    Args:
        description: The robot.
        scene: What surrounds it; the fingers stand as far apart as it says.
        plan_fingers: Count the fingers among the joints to plan for, as the published implementation does; without
            them fewer pairs of links are tested.
    """
    planning, model = pybullet_planning(), RobotModel(description)
    with connect() as client:
        _talk_to(client)
        with urdf_file(description) as file, quiet():
            robot = int(client.loadURDF(str(file), useFixedBase=True))
        for joint in model.finger_joints:
            client.resetJointState(robot, joint, scene.opening / 2)
        obstacles = tuple(_box(client, box.size, box.pose.position, box.pose.orientation) for box in scene.boxes)
        gripper = [model.link(name) - 1 for name in description.gripper.links]
        mounted = [model.link(name) - 1 for name in description.mounted_links]
        fixed = [body for box, body in zip(scene.boxes, obstacles, strict=True) if box.fixed]
        may_touch = {((robot, link), (body, BASE)) for link, body in product(mounted, fixed)}
        attachments = []
        if scene.held:
            held = _box(client, scene.held.size)
            grasp = (scene.held.grasp.position, scene.held.grasp.orientation)
            attachments.append(planning.Attachment(robot, model.tool - 1, grasp, held))
            may_touch |= {((robot, link), (held, BASE)) for link in gripper}
        moving = model.finger_joints if plan_fingers else ()
        joints = (*model.arm_joints, *moving)
        limits = dict(zip(model.arm_joints, zip(model.low.tolist(), model.high.tolist(), strict=True), strict=True))
        collides = planning.get_collision_fn(
            robot,
            joints,
            obstacles=list(obstacles),
            attachments=attachments,
            self_collisions=True,
            disabled_collisions={(model.link(a) - 1, model.link(b) - 1) for a, b in description.may_touch},
            extra_disabled_collisions=may_touch,
            custom_limits=limits,
        )
        fingers = (scene.opening / 2,) * len(moving)
        yield PublishedChecker(client, robot, joints, fingers, obstacles, tuple(attachments), limits, collides)


def _box(
    client: BulletClient,
    size: Size,
    position: Sequence[float] = (0.0, 0.0, 0.0),
    orientation: Sequence[float] = (0.0, 0.0, 0.0, 1.0),
) -> int:
    shape = client.createCollisionShape(client.GEOM_BOX, halfExtents=[side / 2 for side in size])
    return int(client.createMultiBody(0.0, shape, -1, list(position), list(orientation)))


def _talk_to(client: BulletClient) -> None:
    """Turn pybullet-planning to a client: each of its modules keeps the client's number as a constant of its own."""
    for name, module in list(sys.modules.items()):
        if name.startswith("pybullet_planning") and hasattr(module, "CLIENT"):
            module.CLIENT = client.id  # type: ignore[attr-defined]  # a module, which mypy knows no constants of
