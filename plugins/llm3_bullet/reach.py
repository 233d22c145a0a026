"""How far a robot's parts are from the axes that they turn about, and so how far they move when a joint does."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel

Array = NDArray[np.float64]


def joints_below(model: RobotModel) -> NDArray[np.intp]:
    """For each link the number of arm joints between it and the base, (L,)."""
    arm = set(model.arm_joints)
    below = np.zeros(len(model.links), dtype=np.intp)
    for link, parent in enumerate(model.parents[1:], start=1):
        below[link] = below[parent] + (link - 1 in arm)
    return below


def reach(kinematics: Kinematics, points: Sequence[Array], opening: float) -> Array:
    """Bound how far points of the robot move when one arm joint moves, wherever the others stand.

    For a revolute joint this is the greatest distance from its axis. The triangle inequality gives it: to the next
    joint, and from there as far as anything beyond it can be.

    Args:
        kinematics: The robot.
        points: For each link, in the model's order, points (V, 3) in its link frame; V may be 0.
        opening: Distance between the fingers in metres.

    Returns:
        (dof,), metres of travel per radian (per metre, for a prismatic joint) that no point exceeds; 0 for a joint
        that moves none of the points.
    """
    model = kinematics.model
    frames = kinematics.link_frames(model.home[None], opening)[0]
    below = joints_below(model)
    bound = np.zeros(model.dof)
    beyond = -np.inf  # how far anything past the next joint can be from that joint's origin
    for j in reversed(range(model.dof)):
        number = model.arm_joints[j]
        slides = model.joints[number].type == "prismatic"
        origin = frames[number + 1, :3, 3]
        axis = frames[number + 1, :3, :3] @ model.joints[number].axis
        own = [
            hull @ frame[:3, :3].T + frame[:3, 3]
            for hull, frame, joints in zip(points, frames, below, strict=True)
            if joints == j + 1
        ]
        offsets = np.concatenate([np.empty((0, 3)), *own]) - origin
        distances = np.linalg.norm(offsets, axis=1)
        across = np.linalg.norm(np.cross(offsets, axis), axis=1)
        to_next = frames[model.arm_joints[j + 1] + 1, :3, 3] - origin if j + 1 < model.dof else np.zeros(3)
        far = max(np.max(distances, initial=-np.inf), float(np.linalg.norm(to_next)) + beyond)
        wide = max(np.max(across, initial=-np.inf), float(np.linalg.norm(np.cross(to_next, axis))) + beyond)
        bound[j] = 0.0 if far == -np.inf else 1.0 if slides else wide
        # The origin of a sliding joint is where `home` has it, and it may be anywhere within its limits.
        beyond = far + (float(model.high[j] - model.low[j]) if slides else 0.0)
    return bound


def extent(kinematics: Kinematics) -> float:
    """How far the origin of a link can be from the base's, in metres, whatever the joints do: an upper bound."""
    model = kinematics.model
    origins = sum(float(np.linalg.norm(joint.origin[:3, 3])) for joint in model.joints)
    slides = [joint.type == "prismatic" for joint in (model.joints[number] for number in model.arm_joints)]
    sliding = np.maximum(np.abs(model.low), np.abs(model.high))[slides].sum()
    return origins + float(sliding) + model.description.gripper.max_opening
