"""A robot among boxes, for a second opinion: what is where, and how far apart, is PyBullet's word alone.

From the rest of the library comes data: the robot's description, and boxes.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from llm3.types import Pose
from llm3_bullet.clients import BulletClient
from llm3_bullet.poses import Array
from llm3_bullet.robot import RobotDescription
from llm3_bullet.scene import Box
from llm3_bullet.verification.arm import PlainArm
from llm3_bullet.verification.boxes import CORNERS, Frame, matrix
from llm3_bullet.verification.look import HORIZON, Look, Pair
from llm3_bullet.verification.support import overhang


class PlainWorld:
    """A robot, fixed boxes and movable boxes, one of which may be in the hand."""

    def __init__(
        self, client: BulletClient, robot: RobotDescription, fixed: Iterable[Box], movable: Iterable[Box]
    ) -> None:
        """Build it.

        Args:
            client: An empty simulator, which nothing else may use.
            robot: The robot; it may touch what it stands on.
            fixed: Boxes that nothing moves.
            movable: Boxes that the robot may take.
        """
        self._client = client
        self.arm = PlainArm(client, robot)
        fixed, movable = tuple(fixed), tuple(movable)
        self._fixed = {box.name: self._add(box) for box in fixed}
        self._boxes = {box.name: self._add(box) for box in movable}
        self.sizes: dict[str, Array] = {box.name: np.array(box.size) for box in (*fixed, *movable)}
        self.held: str | None = None
        self.grasp = Pose((0.0, 0.0, 0.0))
        self._spared: str | None = None
        self._arrange()

    # ---- what happens ---------------------------------------------------------------------------------

    def move(self, q: Array) -> None:
        """Put the arm, the fingers and what is in the hand there: (dof + 1,), the last value is the opening."""
        self.arm.move(q)
        if self.held:
            self._put(self.held, self.arm.in_hand(self.grasp))

    def put(self, name: str, pose: Pose) -> None:
        """Put a box somewhere."""
        self._put(name, (pose.position, pose.orientation))

    def attach(self, name: str, grasp: Pose) -> float:
        """Fix a box to the hand; the answer is how far it has to jump for that, in metres."""
        before = self.corners(name)
        self.held, self.grasp = name, grasp
        self._put(name, self.arm.in_hand(grasp))
        self._arrange()
        return float(np.linalg.norm(self.corners(name) - before, axis=1).max())

    def detach(self) -> None:
        """Let go."""
        self.held = None
        self._arrange()

    def spare(self, name: str | None) -> None:
        """Let the gripper touch this box, until the next call: it is about to take it, or has just let it go."""
        self._spared = name
        self._arrange()

    # ---- what is seen ---------------------------------------------------------------------------------

    @property
    def names(self) -> tuple[str, ...]:
        """The movable boxes."""
        return tuple(self._boxes)

    @property
    def lever(self) -> float:
        """How far any point of the robot, or of what it holds, moves at most when one joint moves by 1 rad or 1 m."""
        if self.held is None:
            return self.arm.lever
        return self.arm.lever + float(np.linalg.norm(self.grasp.position) + np.linalg.norm(self.sizes[self.held]) / 2)

    def look(self) -> Look:
        """What is to be seen now."""
        gaps = np.full(len(self._pairs), HORIZON)
        for query in self._queries:
            for row in self._client.getClosestPoints(query[0], query[1], HORIZON, *query[2:]):
                index = self._index.get(((row[1], row[3]), (row[2], row[4])))
                if index is not None and row[8] < gaps[index]:
                    gaps[index] = row[8]
        corners = self.arm.corners()
        if self.held:
            corners = np.concatenate([corners, self.corners(self.held)[None]])
        return Look(self._pairs, gaps, corners)

    def corners(self, name: str) -> Array:
        """World positions of a movable box's corners, (8, 3)."""
        position, orientation = self.frame(name)
        return np.asarray((CORNERS * self.sizes[name]) @ matrix(orientation).T + position)

    def frame(self, name: str) -> Frame:
        """Where a movable box is: its centre, and its orientation as a quaternion x, y, z, w."""
        frame: Frame = self._client.getBasePositionAndOrientation(self._boxes[name])
        return frame

    def nearest(self, name: str, link: int) -> tuple[float, Array]:
        """How far a link of the robot is from a box, in metres, negative inside of it; and the way, a unit vector.

        The way is zero where the box is farther than `HORIZON`.
        """
        rows = self._client.getClosestPoints(self.arm.body, self._boxes[name], HORIZON, link)
        nearest = min(rows, key=lambda row: row[8], default=None)
        return (nearest[8], np.array(nearest[7])) if nearest else (HORIZON, np.zeros(3))

    def neighbours(self, name: str) -> dict[str, float]:
        """How far a box is from the boxes near it, in metres, by name; negative where it is inside of one."""
        near: dict[str, float] = {}
        for other, body in {**self._fixed, **self._boxes}.items():
            if other not in (name, self.held):
                for row in self._client.getClosestPoints(self._boxes[name], body, HORIZON):
                    near[other] = min(near.get(other, HORIZON), row[8])
        return near

    def overhang(self, name: str, others: Iterable[str]) -> float:
        """How far a box's centre is from being over what it touches of these, in metres; see `support.overhang`."""
        bodies = {**self._fixed, **self._boxes}
        surroundings = [
            (self._client.getBasePositionAndOrientation(bodies[other]), self.sizes[other]) for other in others
        ]
        return overhang(self.frame(name), self.sizes[name], surroundings)

    # ---- what is compared with what -------------------------------------------------------------------

    def _arrange(self) -> None:
        """Say which pairs must not touch, now that something was taken or let go."""
        arm, gripper = self.arm, self.arm.gripper
        pairs = [
            Pair((arm.body, link), (body, -1), (arm.link_names[link], name))
            for name, body in {**self._fixed, **self._boxes}.items()
            for link in arm.solid
            if not (name in (self.held, self._spared) and link in gripper)
            and not (name in self._fixed and link in arm.mounted)
        ]
        pairs += [Pair((arm.body, a), (arm.body, b), (arm.link_names[a], arm.link_names[b])) for a, b in arm.self_pairs]
        if self.held:
            in_hand = self._boxes[self.held]
            pairs += [
                Pair((in_hand, -1), (body, -1), (self.held, name))
                for name, body in {**self._fixed, **self._boxes}.items()
                if body != in_hand
            ]
        self._pairs = tuple(pairs)
        self._index = {(pair.first, pair.second): index for index, pair in enumerate(pairs)}
        bodies = dict.fromkeys((p.first[0], p.second[0]) for p in pairs if p.first[0] != p.second[0])
        self._queries = [*bodies, *((arm.body, arm.body, a, b) for a, b in arm.self_pairs)]
        moving = [(arm.body, link) for link in arm.solid] + ([(self._boxes[self.held], -1)] if self.held else [])
        rows = {body: row for row, body in enumerate(moving)}
        self._moving = np.array([[rows.get(p.first, -1), rows.get(p.second, -1)] for p in pairs], dtype=int)
        self._moving = self._moving.reshape(-1, 2)  # also where there are none

    def approach(self, travel: Array) -> Array:
        """How much nearer two bodies of each pair can have come, if each moving body travelled this far: (pairs,)."""
        with_standing = np.append(travel, 0.0)  # index -1: what does not move
        return np.asarray(with_standing[self._moving].sum(axis=1))

    def _put(self, name: str, frame: Frame) -> None:
        self._client.resetBasePositionAndOrientation(self._boxes[name], *frame)

    def _add(self, box: Box) -> int:
        shape = self._client.createCollisionShape(self._client.GEOM_BOX, halfExtents=[side / 2 for side in box.size])
        return int(self._client.createMultiBody(0, shape, -1, box.pose.position, box.pose.orientation))
