"""Forward kinematics of many configurations at once.

Every arm joint gets a frame whose z axis is the joint's axis, as Denavit and Hartenberg do it. The transform from one
such frame to the next is then a constant, plus a constant times the cosine of the joint's angle, plus a constant times
its sine. Each link is fixed to the frame of the last arm joint below it, but for the fingers, whose place is linear in
the gripper's opening. So the frames of all arm joints say where everything is.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import DTypeLike, NDArray

from llm3_bullet.model import RobotModel

Array = NDArray[np.float64]

FEW = 8
"""Up to so many configurations the number of numpy calls decides, and above it the number of products."""


class Kinematics:
    """Where the links of a robot are, its base standing at the world's origin."""

    def __init__(self, model: RobotModel, dtype: DTypeLike = np.float64) -> None:
        """Derive the constants.

        Args:
            model: The robot.
            dtype: What to compute in; `numpy.float32` is faster, and right to a micrometre.
        """
        self.model = model
        self._dtype = np.dtype(dtype)
        arm = {number: j for j, number in enumerate(model.arm_joints)}
        fingers = set(model.finger_joints)
        self._slides = np.array([model.joints[number].type == "prismatic" for number in model.arm_joints], dtype=bool)
        between = np.empty((model.dof, 4, 4))  # from an arm joint's frame to the next one's, at position zero
        self._frame = np.zeros(len(model.links), dtype=int)  # the number of arm joints below a link
        self._offset = np.zeros((len(model.links), 4, 4))  # from there to the link, fingers closed
        self._spread = np.zeros((len(model.links), 4, 4))  # what a metre of opening adds to it
        self._offset[0] = np.eye(4)
        for number, joint in enumerate(model.joints):
            link, parent = number + 1, model.parents[number + 1]
            self._frame[link] = self._frame[parent]
            self._offset[link] = self._offset[parent] @ joint.origin
            self._spread[link] = self._spread[parent] @ joint.origin
            if number in arm:
                aligned = _z_onto(joint.axis)
                between[arm[number]] = self._offset[link] @ aligned
                self._offset[link] = aligned.T
                self._frame[link] = arm[number] + 1
            elif number in fingers:
                self._spread[link, :, 3] += self._offset[link] @ np.append(joint.axis, 0.0) / 2
        self._parts = np.array([_parts(*pair) for pair in zip(between, self._slides, strict=True)])
        self._parts = self._parts.reshape(model.dof, 3, 16).astype(self._dtype)
        self._identity = np.eye(4, dtype=self._dtype)
        self._tool_offset = self._offset[model.tool].astype(self._dtype)

    def joint_frames(self, Q: Array) -> Array:
        """World frames of the base and of the arm joints, each joint's z axis being the joint's axis.

        Args:
            Q: Configurations, (N, dof), in radians (metres where a joint slides).

        Returns:
            (N, 4, dof + 1, 4): the frame of joint j in configuration n is the matrix ``[n, :, j]``.
        """
        positions = Q.T.astype(self._dtype)
        factors = np.ones((3, *positions.shape), self._dtype)
        np.cos(positions, out=factors[1])
        np.sin(positions, out=factors[2])
        if self._slides.any():
            factors[1, self._slides] = positions[self._slides]
        chain = (factors.transpose(1, 2, 0) @ self._parts).reshape(*positions.shape, 4, 4)
        if len(Q) <= FEW:
            reach = 1  # each transform spans so many joints already
            while reach < len(chain):
                chain[reach:] = chain[:-reach] @ chain[reach:]
                reach *= 2
        else:
            for j in range(1, len(chain)):
                np.matmul(chain[j - 1], chain[j], out=chain[j])
        frames = np.empty((len(Q), 4, len(chain) + 1, 4), self._dtype)
        frames[:, :, 0] = self._identity
        frames[:, :, 1:] = chain.transpose(1, 2, 0, 3)
        return frames

    def placement(self, links: NDArray[np.intp], points: Array, opening: float) -> Array:
        """The matrix that places points: ``joint_frames(Q).reshape(N, 4, -1) @ placement`` are their world positions.

        Args:
            links: For each point the number of its link, (S,).
            points: In the links' frames, in metres, (S, 3).
            opening: Distance between the fingers in metres; each stands at half of it.

        Returns:
            (4 (dof + 1), S). World positions come homogeneous, as (N, 4, S).
        """
        offsets = (self._offset + opening * self._spread)[links]
        matrix = np.zeros((len(links), self.model.dof + 1, 4))
        local = np.einsum("sij,sj->si", offsets, np.column_stack([points, np.ones(len(points))]))
        matrix[np.arange(len(links)), self._frame[links]] = local
        return np.ascontiguousarray(matrix.reshape(len(links), -1).T, dtype=self._dtype)

    def link_frames(self, Q: Array, opening: float) -> Array:
        """World frames of all links (the URDF's link frames, not the centres of mass).

        Args:
            Q: Configurations, (N, dof), in radians (metres where a joint slides).
            opening: Distance between the fingers in metres; each stands at half of it.

        Returns:
            (N, L, 4, 4), links in the model's order.
        """
        count = len(self.model.links)
        matrix = np.zeros((self.model.dof + 1, 4, count, 4), self._dtype)
        matrix[self._frame, :, np.arange(count)] = self._offset + opening * self._spread
        rows = 4 * (self.model.dof + 1)
        flat = self.joint_frames(Q).reshape(4 * len(Q), rows) @ matrix.reshape(rows, 4 * count)
        return np.ascontiguousarray(flat.reshape(len(Q), 4, count, 4).transpose(0, 2, 1, 3))

    def tool(self, Q: Array) -> Array:
        """World poses of the tool frame for configurations (N, dof): (N, 4, 4)."""
        tool: Array = self.joint_frames(Q)[:, :, -1] @ self._tool_offset
        return tool

    def jacobian(self, Q: Array) -> Array:
        """How the tool moves with the joints, in the world frame: (N, 6, dof).

        Rows are velocity over angular velocity; columns are per radian (per metre, for a prismatic joint).
        """
        return self.tool_and_jacobian(Q)[1]

    def tool_and_jacobian(self, Q: Array) -> tuple[Array, Array]:
        """`tool` and `jacobian` together, at the price of one of them."""
        frames = self.joint_frames(Q)
        tool = frames[:, :, -1] @ self._tool_offset
        axes = frames[:, :3, 1:, 2]
        levers = tool[:, :3, 3, None] - frames[:, :3, 1:, 3]
        ax, ay, az = axes.swapaxes(0, 1)
        lx, ly, lz = levers.swapaxes(0, 1)
        jacobian = np.empty((len(Q), 6, self.model.dof), self._dtype)
        jacobian[:, 0] = ay * lz - az * ly
        jacobian[:, 1] = az * lx - ax * lz
        jacobian[:, 2] = ax * ly - ay * lx
        jacobian[:, 3:] = axes
        for j in np.flatnonzero(self._slides):
            jacobian[:, :3, j], jacobian[:, 3:, j] = axes[:, :, j], 0.0
        return tool, jacobian


def _parts(between: Array, slides: bool) -> Array:
    """The transform to the next frame in three parts (3, 4, 4).

    It is their sum, the second times the cosine and the third times the sine of the joint's angle; for a sliding
    joint, the second times its position.
    """
    x, y, z, origin = between.T
    parts = np.zeros((3, 4, 4))
    if slides:
        parts[0] = between
        parts[1, :, 3] = z
    else:
        parts[0] = np.column_stack([0 * x, 0 * y, z, origin])
        parts[1] = np.column_stack([x, y, 0 * z, 0 * origin])
        parts[2] = np.column_stack([y, -x, 0 * z, 0 * origin])
    return parts


def _z_onto(axis: Array) -> Array:
    """(4, 4): a rotation that takes z onto the axis; the identity if the axis is z already."""
    helper = np.eye(3)[0] if abs(axis[0]) < 0.9 else np.eye(3)[1]
    x = helper - axis * (helper @ axis)
    x /= np.linalg.norm(x)
    rotation = np.eye(4)
    rotation[:3, :3] = np.column_stack([x, np.cross(axis, x), axis])
    return rotation
