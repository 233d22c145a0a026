"""The robot of the second opinion: PyBullet's reading of the URDF file, and the description laid over it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import combinations

import numpy as np

from llm3.types import Pose
from llm3_bullet.clients import BulletClient, quiet
from llm3_bullet.mounting import urdf_file
from llm3_bullet.poses import Array
from llm3_bullet.robot import ParallelGripper, RobotDescription
from llm3_bullet.verification.boxes import CORNERS, Frame, matrices, matrix

_BASE = -1  # PyBullet's number of the link that carries all others


class PlainArm:
    """An arm with a gripper, as PyBullet has it. Links and joints are PyBullet's numbers."""

    def __init__(self, client: BulletClient, robot: RobotDescription) -> None:
        """Load the robot into a simulator."""
        self._client, self.description = client, robot
        with urdf_file(robot) as file, quiet():
            self.body = int(client.loadURDF(str(file), useFixedBase=True))
        info = [client.getJointInfo(self.body, joint) for joint in range(client.getNumJoints(self.body))]
        joints = {row[1].decode(): row[0] for row in info}
        links = {client.getBodyInfo(self.body)[0].decode(): _BASE} | {row[12].decode(): row[0] for row in info}
        self.link_names = {number: name for name, number in links.items()}
        self._parents = {row[0]: row[16] for row in info}
        self.joint_names = robot.arm_joints
        self._joints = [joints[name] for name in self.joint_names]
        self.fingers = tuple(joints[name] for name in robot.gripper.joints)
        """The finger joints, and the links that they carry."""
        self.gripper = {links[name] for name in robot.gripper.links}
        self.mounted = {links[name] for name in robot.mounted_links}
        self._tool = links[robot.tool_link]
        slides = {row[0] for row in info if row[2] == client.JOINT_PRISMATIC}
        self.units = tuple("m" if joint in slides else "rad" for joint in self._joints)
        self.limits: Array = np.array(
            [
                robot.joint_limits.get(name, info[j][8:10])
                for name, j in zip(self.joint_names, self._joints, strict=True)
            ]
        )
        """Lowest and highest position of each joint, (dof, 2)."""
        speeds = [robot.max_velocity.get(name, info[joints[name]][11]) for name in self.joint_names]
        self.max_velocity: Array = np.array([speed if speed > 0 else np.inf for speed in speeds])
        """Per joint, (dof,); infinite where none is known."""
        self.max_acceleration: Array = np.array([robot.max_acceleration.get(name, np.inf) for name in self.joint_names])
        self.solid = tuple(link for link in (_BASE, *range(len(info))) if client.getCollisionShapeData(self.body, link))
        """The links that have a shape."""
        self.self_pairs = self._pairs(frozenset(links[name] for name in pair) for pair in robot.may_touch)
        """Links that could collide with one another."""
        self._local = self._boxes_around_links()
        ranges = {row[0]: row[8:10] for row in info} | dict(zip(self._joints, self.limits.tolist(), strict=True))
        self.lever = max(1.0, self._longest_lever({joint: max(map(abs, ranges[joint])) for joint in slides}))
        """How far a point of the robot moves at most, in metres, when one joint moves by 1 rad or 1 m."""

    def move(self, q: Array) -> None:
        """Put the arm and the fingers there: (dof + 1,), the last value is the distance between the fingers."""
        values = [[value] for value in q[:-1].tolist()] + [[float(q[-1]) / 2]] * len(self.fingers)
        self._client.resetJointStatesMultiDof(self.body, [*self._joints, *self.fingers], values)

    def in_hand(self, grasp: Pose) -> Frame:
        """Where something is in the world that has this pose in the tool frame."""
        link = self._client.getLinkState(self.body, self._tool, computeForwardKinematics=True)
        frame: Frame = self._client.multiplyTransforms(link[4], link[5], grasp.position, grasp.orientation)
        return frame

    def closing_direction(self) -> Array:
        """In the world, (3,), a unit vector: along which the fingers close; zero without fingers."""
        gripper = self.description.gripper
        axis = gripper.closing_axis if isinstance(gripper, ParallelGripper) else (0.0, 0.0, 0.0)
        return np.asarray(matrix(self.in_hand(Pose((0.0, 0.0, 0.0)))[1]) @ axis)

    def rim(self, count: int = 16) -> Array:
        """Points on the rim of a suction cup, in the world, (count, 3); none for a gripper with fingers."""
        gripper = self.description.gripper
        if isinstance(gripper, ParallelGripper):
            return np.empty((0, 3))
        angles = np.linspace(0.0, 2 * np.pi, count, endpoint=False)
        local = gripper.cup_radius * np.column_stack([np.cos(angles), np.sin(angles), np.zeros(count)])
        position, orientation = self.in_hand(Pose((0.0, 0.0, 0.0)))
        return np.asarray(local @ matrix(orientation).T + position)

    def corners(self) -> Array:
        """World positions of the corners of a box around each link of `solid`, (links, 8, 3).

        The box is fixed to the link. No point of the link moves farther from one configuration to another than the
        corner of its box that moves farthest: how far a point of a rigid body is displaced is a convex function of
        the point.
        """
        positions, axes = self._link_frames()
        return np.asarray(self._local @ axes.transpose(0, 2, 1) + positions[:, None])

    def _link_frames(self) -> tuple[Array, Array]:
        """Positions (links, 3) and axes (links, 3, 3) of the links of `solid`."""
        client = self._client
        moving = [link for link in self.solid if link != _BASE]
        states = [(row[4], row[5]) for row in client.getLinkStates(self.body, moving, computeForwardKinematics=True)]
        if _BASE in self.solid:
            states.insert(0, client.getBasePositionAndOrientation(self.body))  # any frame will do: it stands still
        return np.array([row[0] for row in states]), matrices(np.array([row[1] for row in states]))

    def _boxes_around_links(self) -> Array:
        """The corners in each link's own frame, (links, 8, 3)."""
        self.move(np.zeros(len(self._joints) + 1))
        around = np.array([self._client.getAABB(self.body, link) for link in self.solid])  # (links, 2, 3)
        middle, size = around.mean(axis=1)[:, None], (around[:, 1] - around[:, 0])[:, None]
        positions, axes = self._link_frames()
        return np.asarray((CORNERS * size + middle - positions[:, None]) @ axes)

    def _longest_lever(self, slides: Mapping[int, float]) -> float:
        """The longest way from a joint along the links to a point of the robot: no lever is longer.

        Args:
            slides: The sliding joints, and how far each can move out of its zero position, in metres.
        """
        self.move(np.zeros(len(self._joints) + 1))
        rows = self._client.getLinkStates(self.body, list(self._parents), computeForwardKinematics=True)
        at = {link: np.array(row[4]) for link, row in zip(self._parents, rows, strict=True)}
        ways: dict[int, float] = {_BASE: 0.0}
        for link, parent in self._parents.items():  # parents come first
            ways[link] = ways[parent] + slides.get(link, 0.0)
            ways[link] += float(np.linalg.norm(at[link] - at[parent])) if parent in at else 0.0
        reach = np.linalg.norm(self._local, axis=2).max(axis=1)
        return max(ways[link] + float(radius) for link, radius in zip(self.solid, reach, strict=True))

    def _pairs(self, always: Iterable[frozenset[int]]) -> tuple[tuple[int, int], ...]:
        """Pairs of links that could collide: not one rigid body, not neighbours, not always in touch, not a gripper."""
        ignored = set(always)
        return tuple(
            (a, b)
            for a, b in combinations(self.solid, 2)
            if frozenset((a, b)) not in ignored
            and not {a, b} <= self.gripper  # which closes on itself
            and self._anchor(a) != self._anchor(b)
            and not self._adjacent(a, b)
        )

    def _anchor(self, link: int) -> int:
        """The nearest link below that moves against its parent: links with the same one are one rigid body."""
        while link in self._parents and link not in self._joints and link not in self.fingers:
            link = self._parents[link]
        return link

    def _adjacent(self, a: int, b: int) -> bool:
        ways = ((self._anchor(a), self._anchor(b)), (self._anchor(b), self._anchor(a)))
        return any(self._anchor(self._parents[x]) == y for x, y in ways if x != _BASE)
