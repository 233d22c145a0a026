"""The quickest answer for a single configuration: PyBullet's own collision step, in a world where all is thicker.

That step looks at all bodies at once and leaves out those whose bounding boxes are apart, so it takes a fraction of the
time of closest-point queries. But it knows no clearance, it keeps contacts from one step to the next, and its distances
differ from those of the queries by a fraction of a millimetre. So every body is thicker here by half of `THICKNESS`:
where not even these touch, the real ones are clear by any clearance up to `LARGEST_CLEARANCE`.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.box_pool import AWAY, FIXED, HELD, BoxPool, Role
from llm3_bullet.clients import BulletClient
from llm3_bullet.hulls import thickened
from llm3_bullet.model import RobotModel
from llm3_bullet.poses import quaternions
from llm3_bullet.robot_body import RobotBody
from llm3_bullet.scene import Scene, Size
from llm3_bullet.self_collision import Pair

Array = NDArray[np.float64]

THICKNESS = 0.006
"""What two bodies together are thicker by, in metres."""
LARGEST_CLEARANCE = THICKNESS - 0.001
"""The rest is more than PyBullet's distances differ by."""

_ARM, _MOUNTED, _GRIPPER, _BOX, _FIXED, _HELD = (1 << bit for bit in range(6))
_ROBOT = _ARM | _MOUNTED | _GRIPPER
_MEETS = {
    _ARM: _ROBOT | _BOX | _FIXED | _HELD,
    _MOUNTED: _ROBOT | _BOX | _HELD,
    _GRIPPER: _ROBOT | _BOX | _FIXED,
    _BOX: _ROBOT | _HELD,
    _FIXED: _ARM | _GRIPPER | _HELD,
    _HELD: _ARM | _MOUNTED | _BOX | _FIXED,
}
"""What each group of bodies may collide with."""


class ThickWorld:
    """The robot and a scene's boxes, all of them thicker. Nothing else in the client's world may collide."""

    def __init__(self, client: BulletClient, model: RobotModel, hulls: Sequence[Array], pairs: Sequence[Pair]) -> None:
        """Build the robot.

        Args:
            client: The world.
            model: The robot.
            hulls: For each link points (V, 3) in its frame whose convex hull covers it.
            pairs: The pairs of links that may come near each other and must not touch.
        """
        self._client = client
        self.boxes = BoxPool(client, self._box)
        self._scene = Scene()
        robot = self._build(model, hulls)
        self._body = RobotBody(client, robot, model)
        gripper = {model.link(name) for name in model.description.gripper.links}
        mounted = {model.link(name) for name in model.description.mounted_links}
        for link in range(len(model.links)):
            group = _GRIPPER if link in gripper else _MOUNTED if link in mounted else _ARM
            client.setCollisionFilterGroupMask(robot, link - 1, group, _MEETS[group])
        for a, b in combinations(range(len(model.links)), 2):
            if (a, b) not in pairs:
                client.setCollisionFilterPair(robot, robot, a - 1, b - 1, 0)

    def show(self, scene: Scene) -> None:
        """Put the scene's boxes where they are."""
        if scene is not self._scene:
            self.boxes.show(scene)
            self._body.open(scene.opening)
            self._scene = scene

    def is_clear(self, q: Sequence[float]) -> bool:
        """Whether nothing touches in a configuration (dof,) although all is thicker."""
        self._body.pose(q)
        if self._scene.held:
            self._body.hold(self.boxes.held, self._scene.held.grasp)
        self._client.performCollisionDetection()
        return all(point[8] >= 0 for point in self._client.getContactPoints())

    def _box(self, size: Size, role: Role) -> int:
        half = [(side + THICKNESS) / 2 for side in size]
        shape = self._client.createCollisionShape(self._client.GEOM_BOX, halfExtents=half)
        # Made away from the robot: PyBullet looks for partners when something moves, and the groups come after.
        body = int(self._client.createMultiBody(0.0, shape, -1, AWAY[role]))
        group = {FIXED: _FIXED, HELD: _HELD}.get(role, _BOX)
        self._client.setCollisionFilterGroupMask(body, -1, group, _MEETS[group])
        return body

    def _build(self, model: RobotModel, hulls: Sequence[Array]) -> int:
        client = self._client
        kinds = {"fixed": client.JOINT_FIXED, "prismatic": client.JOINT_PRISMATIC}
        shapes = [self._shape(hull) for hull in hulls]
        origins = np.array([joint.origin for joint in model.joints])
        count = len(model.joints)
        return int(
            client.createMultiBody(
                0.0,
                shapes[0],
                linkMasses=[1.0] * count,
                linkCollisionShapeIndices=shapes[1:],
                linkVisualShapeIndices=[-1] * count,
                linkPositions=origins[:, :3, 3].tolist(),
                linkOrientations=quaternions(origins).tolist(),
                # Shapes that are not centred on their inertial frame are culled by their own bounding boxes once more.
                linkInertialFramePositions=[_middle(hull) for hull in hulls[1:]],
                linkInertialFrameOrientations=[[0.0, 0.0, 0.0, 1.0]] * count,
                linkParentIndices=list(model.parents[1:]),
                linkJointTypes=[kinds.get(joint.type, client.JOINT_REVOLUTE) for joint in model.joints],
                linkJointAxis=[joint.axis.tolist() for joint in model.joints],
                flags=client.URDF_USE_SELF_COLLISION,
            )
        )

    def _shape(self, hull: Array) -> int:
        if not len(hull):
            return -1
        points = thickened(hull, THICKNESS / 2)
        return int(self._client.createCollisionShape(self._client.GEOM_MESH, vertices=points.tolist()))


def _middle(hull: Array) -> list[float]:
    middle: list[float] = (hull.mean(axis=0) if len(hull) else np.zeros(3)).tolist()
    return middle
