"""The verdict on a collision in plain PyBullet calls: what the checker must agree with, written independently."""

from __future__ import annotations

import numpy as np

from llm3_bullet.mounting import urdf_file
from llm3_bullet.robot import RobotDescription
from llm3_bullet.scene import Scene


class PlainWorld:
    """One robot and one scene in a client of their own; PyBullet does all the kinematics."""

    def __init__(self, client, description: RobotDescription, scene: Scene) -> None:
        self.client, self.description, self.scene = client, description, scene
        with urdf_file(description) as file:
            self.robot = client.loadURDF(str(file), useFixedBase=True)
        infos = [client.getJointInfo(self.robot, i) for i in range(client.getNumJoints(self.robot))]
        self.joints = {info[1].decode(): info[0] for info in infos}
        self.links = {client.getBodyInfo(self.robot)[0].decode(): -1}
        self.links |= {info[12].decode(): info[0] for info in infos}
        self.parents = {info[0]: info[16] for info in infos}
        self.fixed = {info[0] for info in infos if info[2] == client.JOINT_FIXED}
        self.bodies = [self._box(box.size, box.pose) for box in scene.boxes]
        self.held = self._box(scene.held.size, scene.held.grasp) if scene.held else None
        self.pairs = [(a, b) for a in self.links.values() for b in self.links.values() if self._counts(a, b)]

    def _box(self, size, pose) -> int:
        shape = self.client.createCollisionShape(self.client.GEOM_BOX, halfExtents=[s / 2 for s in size])
        return self.client.createMultiBody(0, shape, -1, pose.position, pose.orientation)

    def _root(self, link: int) -> int:
        while link in self.fixed:
            link = self.parents[link]
        return link

    def _counts(self, a: int, b: int) -> bool:
        gripper = {self.links[name] for name in self.description.gripper.links}
        allowed = [{self.links[one], self.links[other]} for one, other in self.description.may_touch]
        return (
            a < b
            and self.parents[b] != a
            and self._root(a) != self._root(b)
            and not {a, b} <= gripper
            and {a, b} not in allowed
        )

    def free(self, q: np.ndarray, clearance: float) -> bool:
        for name, value in zip(self.description.arm_joints, q, strict=True):
            self.client.resetJointState(self.robot, self.joints[name], value)
        for name in self.description.gripper.joints:
            self.client.resetJointState(self.robot, self.joints[name], self.scene.opening / 2)
        return not any(distance < clearance for distance in self._distances(clearance))

    def _distances(self, horizon: float):
        closest = self.client.getClosestPoints
        mounted = {self.links[name] for name in self.description.mounted_links}
        gripper = {self.links[name] for name in self.description.gripper.links}
        for box, body in zip(self.scene.boxes, self.bodies, strict=True):
            for link in self.links.values():
                if not (box.fixed and link in mounted):
                    yield from (row[8] for row in closest(self.robot, body, horizon, link, -1))
        for a, b in self.pairs:
            yield from (row[8] for row in closest(self.robot, self.robot, horizon, b, a))
        if self.held is not None:
            tool = self.links[self.description.tool_link]
            frame = self.client.getLinkState(self.robot, tool, computeForwardKinematics=True)[4:6]
            grasp = self.scene.held.grasp
            pose = self.client.multiplyTransforms(*frame, grasp.position, grasp.orientation)
            self.client.resetBasePositionAndOrientation(self.held, *pose)
            for body in self.bodies:
                yield from (row[8] for row in closest(self.held, body, horizon))
            for link in set(self.links.values()) - gripper:
                yield from (row[8] for row in closest(self.held, self.robot, horizon, -1, link))
