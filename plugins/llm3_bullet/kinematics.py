"""Forward kinematics of many configurations at once.

Every arm joint gets a frame whose z axis is the joint's axis, as Denavit and Hartenberg do it: a revolute
joint then turns x and y, a prismatic one shifts the origin along z. What lies between two arm joints is one
fixed transform, and each link is fixed to the frame of the last arm joint below it, but for the fingers, whose
place is linear in the gripper's opening.

The frames of N configurations are kept as their columns x, y, z and origin, shape (4, 3, N). A fixed transform
is then a single matrix product of (4, 4) with (4, 3 N), whatever N is.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.model import RobotModel

Array = NDArray[np.float64]


class Kinematics:
    """Where the links of a robot are, its base standing at the world's origin."""

    def __init__(self, model: RobotModel) -> None:
        self.model = model
        arm = {number: j for j, number in enumerate(model.arm_joints)}
        fingers = set(model.finger_joints)
        self._slides = [model.joints[number].type == "prismatic" for number in model.arm_joints]
        self._between = np.empty((model.dof, 4, 4))  # from an arm joint's frame to the next one's
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
                self._between[arm[number]] = self._offset[link] @ aligned
                self._offset[link] = aligned.T
                self._frame[link] = arm[number] + 1
            elif number in fingers:
                self._spread[link, :, 3] += self._offset[link] @ np.append(joint.axis, 0.0) / 2
        self._order = np.argsort(self._frame, kind="stable")  # links of one frame side by side
        self._in_order = bool((np.diff(self._order) == 1).all())
        self._rows = 4 * np.searchsorted(self._frame[self._order], np.arange(model.dof + 2))

    def link_frames(self, Q: Array, opening: float) -> Array:
        """World frames of all links (the URDF's link frames, not the centres of mass).

        Args:
            Q: Configurations, (N, dof), in radians (metres where a joint slides).
            opening: Distance between the fingers in metres; each stands at half of it.

        Returns:
            (N, L, 4, 4), links in the model's order.
        """
        columns = self.link_columns(Q, opening)
        frames = np.empty((len(Q), len(columns), 4, 4))
        frames[:, :, :3] = columns.transpose(3, 0, 2, 1)
        frames[:, :, 3] = (0.0, 0.0, 0.0, 1.0)
        return frames

    def link_columns(self, Q: Array, opening: float) -> Array:
        """What `link_frames` says, as columns x, y, z and origin: (L, 4, 3, N).

        It saves the reordering, and points (k, 3) of link l are placed by one matrix product:
        ``np.column_stack([points, np.ones(k)]) @ columns[l].reshape(4, -1)``, reshaped to (k, 3, N).
        """
        frames = self._joint_frames(Q)
        offsets = (self._offset + opening * self._spread)[self._order].swapaxes(1, 2).reshape(-1, 4)
        placed = np.empty((len(offsets), 3 * len(Q)))
        for j, frame in enumerate(frames):
            rows = slice(self._rows[j], self._rows[j + 1])
            np.matmul(offsets[rows], frame.reshape(4, 3 * len(Q)), out=placed[rows])
        columns = placed.reshape(len(self._order), 4, 3, len(Q))
        return columns if self._in_order else columns[np.argsort(self._order)]

    def tool(self, Q: Array) -> Array:
        """World poses of the tool frame for configurations (N, dof): (N, 4, 4)."""
        return _as_matrices(self._tool(self._joint_frames(Q)))

    def jacobian(self, Q: Array) -> Array:
        """How the tool moves with the joints, in the world frame: (N, 6, dof).

        Rows are velocity over angular velocity; columns are per radian (per metre, for a prismatic joint).
        """
        return self.tool_and_jacobian(Q)[1]

    def tool_and_jacobian(self, Q: Array) -> tuple[Array, Array]:
        """`tool` and `jacobian` together, at the price of one of them."""
        frames = self._joint_frames(Q)
        tool = self._tool(frames)
        axes, origins = frames[1:, 2], frames[1:, 3]
        jacobian = np.zeros((6, self.model.dof, len(Q)))
        (ax, ay, az), (lx, ly, lz) = axes.swapaxes(0, 1), (tool[3] - origins).swapaxes(0, 1)
        jacobian[0] = ay * lz - az * ly
        jacobian[1] = az * lx - ax * lz
        jacobian[2] = ax * ly - ay * lx
        jacobian[3:] = axes.swapaxes(0, 1)
        for j in np.flatnonzero(self._slides):
            jacobian[:3, j], jacobian[3:, j] = axes[j], 0.0
        return _as_matrices(tool), np.ascontiguousarray(jacobian.transpose(2, 0, 1))

    def _joint_frames(self, Q: Array) -> Array:
        """The base's and the arm joints' frames by columns, (dof + 1, 4, 3, N)."""
        positions = np.ascontiguousarray(Q.T)
        cosines, sines = np.cos(positions), np.sin(positions)
        signed = np.stack([sines, -sines], axis=1)[:, :, None]
        frames = np.empty((len(positions) + 1, 4, 3, len(Q)))
        frames[0] = np.eye(4)[:, :3, None]
        flat = frames.reshape(len(frames), 4, 3 * len(Q))
        for j, between in enumerate(self._between):
            np.matmul(between.T, flat[j], out=flat[j + 1])
            if self._slides[j]:
                frames[j + 1, 3] += positions[j] * frames[j + 1, 2]
            else:  # x cos + y sin, y cos - x sin
                xy = frames[j + 1, :2]
                swapped = xy[::-1] * signed[j]
                xy *= cosines[j]
                xy += swapped
        return frames

    def _tool(self, frames: Array) -> Array:
        count = frames.shape[-1]
        columns: Array = self._offset[self.model.tool].T @ frames[-1].reshape(4, 3 * count)
        return columns.reshape(4, 3, count)


def _as_matrices(columns: Array) -> Array:
    matrices = np.zeros((columns.shape[2], 4, 4))
    matrices[:, :3] = columns.transpose(2, 1, 0)
    matrices[:, 3, 3] = 1.0
    return matrices


def _z_onto(axis: Array) -> Array:
    """(4, 4): a rotation that takes z onto the axis; the identity if the axis is z already."""
    helper = np.eye(3)[0] if abs(axis[0]) < 0.9 else np.eye(3)[1]
    x = helper - axis * (helper @ axis)
    x /= np.linalg.norm(x)
    rotation = np.eye(4)
    rotation[:3, :3] = np.column_stack([x, np.cross(axis, x), axis])
    return rotation
