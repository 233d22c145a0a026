"""A slow and plain answer to the question whether an arm reaches a pose. It shares no code with llm3.

What differs from `llm3_bullet` on purpose: rotations by Rodrigues' formula in the URDF's own frames; the error of a
pose as the difference of matrices, which has no branches; joint limits by the substitution q = middle + half * sin(u),
which needs no projection; Levenberg and Marquardt's steps with a damping that is raised until the error falls (D. W.
Marquardt, "An Algorithm for Least-Squares Estimation of Nonlinear Parameters", SIAM Journal 11(2), 1963); starts that
are uniformly random, and very many of them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np

REACHED = (1e-7, 1e-6)
"""A pose counts as reached within this many metres and radians."""


@dataclass(frozen=True)
class Chain:
    """An arm from its base to its tool: for each joint a fixed transform, and then a turn about an axis."""

    rotations: np.ndarray
    """(dof + 1, 3, 3): from one joint to the next; the last one leads to the tool."""
    shifts: np.ndarray
    """(dof + 1, 3), in metres."""
    axes: np.ndarray
    """(dof, 3)."""
    low: np.ndarray
    high: np.ndarray


def read_chain(
    urdf: Path,
    tip: str,
    limits: Mapping[str, tuple[float, float]] | None = None,
    base: float = 0.0,
    beyond: float = 0.0,
) -> Chain:
    """The revolute joints of a URDF file from the base to a link.

    Args:
        urdf: The file.
        tip: The link.
        limits: In radians, by joint name, in place of the file's.
        base: How high the arm stands, in metres.
        beyond: How far the tool is from the link along the link's z axis, in metres.
    """
    carriers = {joint.find("child").get("link"): joint for joint in ET.parse(urdf).getroot().findall("joint")}
    joints = []
    while tip in carriers:
        joints.insert(0, carriers[tip])
        tip = carriers[tip].find("parent").get("link")
    rotations, shifts, axes, bounds = [np.eye(3)], [np.array([0.0, 0.0, base])], [], []
    for joint in joints:
        origin, limit = joint.find("origin"), joint.find("limit")
        roll, pitch, yaw = _numbers(origin, "rpy")
        shifts[-1] = shifts[-1] + rotations[-1] @ _numbers(origin, "xyz")
        rotations[-1] = rotations[-1] @ _turn(2, yaw) @ _turn(1, pitch) @ _turn(0, roll)
        if joint.get("type") != "fixed":
            assert joint.get("type") == "revolute", joint.get("type")
            axes.append(_numbers(joint.find("axis"), "xyz"))
            stated = float(limit.get("lower")), float(limit.get("upper"))
            bounds.append((limits or {}).get(joint.get("name"), stated))
            rotations.append(np.eye(3))
            shifts.append(np.zeros(3))
    shifts[-1] = shifts[-1] + beyond * rotations[-1][:, 2]
    return Chain(np.array(rotations), np.array(shifts), np.array(axes), *np.array(bounds).T)


def _numbers(element, key):
    text = None if element is None else element.get(key)
    return np.array([float(word) for word in (text or "0 0 0").split()])


def _turn(axis, angle):
    first, second = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[first, first] = matrix[second, second] = np.cos(angle)
    matrix[second, first] = np.sin(angle)
    matrix[first, second] = -matrix[second, first]
    return matrix


def forward(chain: Chain, Q: np.ndarray):
    """Tool rotations (N, 3, 3) and positions (N, 3), and the joints' axes and origins (dof, N, 3), in the world."""
    crosses = np.cross(np.eye(3), chain.axes[:, None])  # crosses[j] @ v is axis j × v
    R = np.broadcast_to(chain.rotations[0], (len(Q), 3, 3))
    p = np.broadcast_to(chain.shifts[0], (len(Q), 3))
    axes, origins = [], []
    for j, (axis, cross) in enumerate(zip(chain.axes, crosses, strict=True)):
        axes.append(R @ axis)
        origins.append(p)
        angle = Q[:, j, None, None]
        turned = R @ (np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * (cross @ cross))
        p = p + turned @ chain.shifts[j + 1]
        R = turned @ chain.rotations[j + 1]
    return R, p, np.array(axes), np.array(origins)


def residuals(chain: Chain, Q: np.ndarray, targets: np.ndarray):
    """What separates the tool from targets (N, 4, 4): (N, 12), and how it changes with the joints, (N, 12, dof).

    Three components are metres; nine are those of the rotation matrices' difference, scaled so that their length is
    2 sin(angle / 2).
    """
    R, p, axes, origins = forward(chain, Q)
    difference = np.empty((len(Q), 12))
    difference[:, :3] = p - targets[:, :3, 3]
    difference[:, 3:] = (R - targets[:, :3, :3]).swapaxes(1, 2).reshape(-1, 9) / np.sqrt(2)
    change = np.empty((len(Q), 12, Q.shape[1]))
    for j, (axis, origin) in enumerate(zip(axes, origins, strict=True)):
        change[:, :3, j] = np.cross(axis, p - origin)
        change[:, 3:, j] = np.cross(axis[:, None], R.swapaxes(1, 2)).reshape(-1, 9) / np.sqrt(2)
    return difference, change


def shortfalls(chain: Chain, Q: np.ndarray, targets: np.ndarray) -> np.ndarray:
    """Distances in metres and angles in radians between the tool and targets, (N, 2)."""
    R, p, *_ = forward(chain, Q)
    chords = np.linalg.norm(R - targets[:, :3, :3], axis=(1, 2)) / np.sqrt(8)
    return np.column_stack([np.linalg.norm(p - targets[:, :3, 3], axis=1), 2 * np.arcsin(np.minimum(chords, 1.0))])


def fit(chain: Chain, Q: np.ndarray, targets: np.ndarray, steps: int) -> np.ndarray:
    """Let each configuration (N, dof) approach its target (N, 4, 4)."""
    middle, half = (chain.high + chain.low) / 2, (chain.high - chain.low) / 2
    u = np.arcsin(np.clip((Q - middle) / half, -1.0, 1.0))
    damping = np.full(len(Q), 1e-2)
    error, change = residuals(chain, Q, targets)
    open_ = np.arange(len(Q))
    for _ in range(steps):
        J = change[open_] * (half * np.cos(u[open_]))[:, None]
        square = J.swapaxes(1, 2) @ J
        square += damping[open_, None, None] * np.eye(Q.shape[1])
        step = np.linalg.solve(square, J.swapaxes(1, 2) @ error[open_, :, None])[:, :, 0]
        tried = u[open_] - step
        new_error, new_change = residuals(chain, middle + half * np.sin(tried), targets[open_])
        better = (new_error**2).sum(axis=1) < (error[open_] ** 2).sum(axis=1)
        damping[open_] *= np.where(better, 0.2, 5.0)
        taken = open_[better]
        u[taken], error[taken], change[taken] = tried[better], new_error[better], new_change[better]
        damping.clip(1e-14, 1e8, out=damping)
        size = (error[open_] ** 2).sum(axis=1)
        open_ = open_[(size > 1e-18) & (damping[open_] < 1e7)]
        if not len(open_):
            break
    return middle + half * np.sin(u)


def best_attempts(chain: Chain, targets: np.ndarray, starts: int, steps: int, rng: np.random.Generator):
    """The best of so many random starts for each target (B, 4, 4): configurations (B, dof), shortfalls (B, 2)."""
    count, dof = len(targets), len(chain.low)
    Q = rng.uniform(chain.low, chain.high, (count * starts, dof))
    repeated = np.repeat(targets, starts, axis=0)
    Q = fit(chain, Q, repeated, steps)
    short = shortfalls(chain, Q, repeated).reshape(count, starts, 2)
    best = np.hypot(*short.transpose(2, 0, 1)).argmin(axis=1)
    return Q.reshape(count, starts, dof)[np.arange(count), best], short[np.arange(count), best]
