"""A world of its own for a second opinion: PyBullet's kinematics and closest points, and none of the planner's code.

Only data is taken from the project: sizes, poses, and the robot's description.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from types import TracebackType

import numpy as np
import pybullet as p
from numpy.typing import NDArray

from llm3.types import Pose
from llm3_bullet.robot import RobotDescription
from llm3_bullet.scene import Box

Touch = tuple[float, str]
"""A depth in metres, and what touches what."""
Frame = tuple[Sequence[float], Sequence[float]]
"""Position and quaternion x, y, z, w; not a Pose, which is rounded."""
CORNERS = np.array(np.meshgrid(*[[-0.5, 0.5]] * 3)).reshape(3, -1).T


class PlainWorld:
    """A robot, fixed boxes and movable boxes, one of which may be in the hand. Use it in a ``with``."""

    def __init__(
        self, robot: RobotDescription, joints: Sequence[str], fixed: Iterable[Box], movable: Iterable[Box]
    ) -> None:
        self._client = p.connect(p.DIRECT)
        self._robot = p.loadURDF(str(robot.urdf), useFixedBase=True, physicsClientId=self._client)
        info = [p.getJointInfo(self._robot, j, physicsClientId=self._client) for j in range(self._count())]
        names = [row[1].decode() for row in info]
        base = p.getBodyInfo(self._robot, physicsClientId=self._client)[0].decode()
        links = {base: -1} | {row[12].decode(): row[0] for row in info}
        self._parents = {row[0]: row[16] for row in info}
        self._arm = [names.index(name) for name in joints]
        self._fingers = [names.index(name) for name in robot.gripper.joints]
        self._hand = {links[name] for name in robot.gripper.links}
        self._tool = links[robot.tool_link]
        self._mounted = {links[name] for name in robot.mounted_links}
        self._self_pairs = self._pairs(frozenset(links[name] for name in pair) for pair in robot.may_touch)
        self._fixed = {box.name: self._add(box) for box in fixed}
        self._boxes = {box.name: self._add(box) for box in movable}
        self.sizes = {box.name: box.size for box in movable}
        self.limits: NDArray[np.float64] = np.array([robot.joint_limits[name] for name in joints])
        self.opening = robot.gripper.max_opening
        self.held: str | None = None
        self._grasp = Pose((0.0, 0.0, 0.0))

    def __enter__(self) -> PlainWorld:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        p.disconnect(physicsClientId=self._client)

    def move(self, q: NDArray[np.float64]) -> None:
        """Put the arm there, the fingers where they are to be, and the held box into the hand."""
        values = [[value] for value in q] + [[self.opening / 2]] * len(self._fingers)
        p.resetJointStatesMultiDof(self._robot, self._arm + self._fingers, values, physicsClientId=self._client)
        if self.held:
            self._put(self.held, self._in_hand(self._grasp))

    def put(self, name: str, pose: Pose) -> None:
        """Put a box somewhere."""
        self._put(name, (pose.position, pose.orientation))

    def attach(self, name: str, grasp: Pose) -> float:
        """Fix a box to the hand; answers how far it has to jump for that, in metres."""
        jump = np.subtract(self._in_hand(grasp)[0], self.corners(name).mean(axis=0))
        self.held, self._grasp = name, grasp
        return float(np.linalg.norm(jump))

    def detach(self) -> None:
        """Let go."""
        self.held = None

    def tool(self) -> NDArray[np.float64]:
        """World position of the tool, (3,)."""
        return np.array(self._in_hand(Pose((0.0, 0.0, 0.0)))[0])

    def corners(self, name: str) -> NDArray[np.float64]:
        """World positions of a box's corners, (8, 3)."""
        position, orientation = p.getBasePositionAndOrientation(self._boxes[name], physicsClientId=self._client)
        axes = np.array(p.getMatrixFromQuaternion(orientation)).reshape(3, 3)
        return np.asarray((CORNERS * self.sizes[name]) @ axes.T + position)

    def finger_gap(self, name: str) -> float:
        """How far the farther finger is from a box, in metres; negative where it is inside."""
        return max(
            min((row[8] for row in self._closest(self._robot, self._boxes[name], 0.1, finger)), default=0.1)
            for finger in self._fingers
        )

    def touches(self) -> Iterator[Touch]:
        """All that touch, but for the hand and what it holds, and the mount and what it stands on."""
        for name, body in {**self._fixed, **self._boxes}.items():
            held, fixed = name == self.held, name in self._fixed
            for row in self._closest(self._robot, body):
                if not (held and row[3] in self._hand) and not (fixed and row[3] in self._mounted):
                    yield -row[8], f"link {row[3]} touches {name}"
            if self.held and not held:
                for row in self._closest(self._boxes[self.held], body):
                    yield -row[8], f"held {self.held} touches {name}"
        for a, b in self._self_pairs:
            for row in self._closest(self._robot, self._robot, 0.0, a, b):
                yield -row[8], f"link {a} touches link {b}"

    def _closest(self, a: int, b: int, distance: float = 0.0, *links: int) -> Iterable[Sequence[float]]:
        rows: Iterable[Sequence[float]] = p.getClosestPoints(a, b, distance, *links, physicsClientId=self._client)
        return rows

    def _put(self, name: str, frame: Frame) -> None:
        p.resetBasePositionAndOrientation(self._boxes[name], *frame, physicsClientId=self._client)

    def _in_hand(self, grasp: Pose) -> Frame:
        link = p.getLinkState(self._robot, self._tool, computeForwardKinematics=True, physicsClientId=self._client)
        frame: Frame = p.multiplyTransforms(link[4], link[5], grasp.position, grasp.orientation)
        return frame

    def _add(self, box: Box) -> int:
        half = [side / 2 for side in box.size]
        shape = p.createCollisionShape(p.GEOM_BOX, halfExtents=half, physicsClientId=self._client)
        pose = box.pose
        body: int = p.createMultiBody(0, shape, -1, pose.position, pose.orientation, physicsClientId=self._client)
        return body

    def _count(self) -> int:
        count: int = p.getNumJoints(self._robot, physicsClientId=self._client)
        return count

    def _pairs(self, always: Iterable[frozenset[int]]) -> list[tuple[int, int]]:
        """Pairs of links that could collide: not one rigid body, not neighbours, and not always in touch."""
        ignored = set(always)
        shapes = (-1, *range(self._count()))
        solid = [a for a in shapes if p.getCollisionShapeData(self._robot, a, physicsClientId=self._client)]
        return [
            (a, b)
            for a, b in combinations(solid, 2)
            if frozenset((a, b)) not in ignored and self._anchor(a) != self._anchor(b) and not self._adjacent(a, b)
        ]

    def _anchor(self, link: int) -> int:
        """The nearest link below that moves against its parent: links with the same one are one rigid body."""
        while link in self._parents and link not in self._arm and link not in self._fingers:
            link = self._parents[link]
        return link

    def _adjacent(self, a: int, b: int) -> bool:
        ways = ((self._anchor(a), self._anchor(b)), (self._anchor(b), self._anchor(a)))
        return any(self._anchor(self._parents[x]) == y for x, y in ways if x >= 0)
