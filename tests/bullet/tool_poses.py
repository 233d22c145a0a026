"""Tool poses for tests."""

from __future__ import annotations

import numpy as np


def top_down(x, y, z, yaw):
    """The tool pointing down; scalars give (4, 4), arrays (N,) give (N, 4, 4)."""
    x, y, z, yaw = np.broadcast_arrays(x, y, z, yaw)
    poses = np.zeros((*x.shape, 4, 4))
    poses[..., 0, 0], poses[..., 1, 0] = np.cos(yaw), np.sin(yaw)
    poses[..., 0, 1], poses[..., 1, 1] = np.sin(yaw), -np.cos(yaw)
    poses[..., 2, 2], poses[..., 3, 3] = -1.0, 1.0
    poses[..., 0, 3], poses[..., 1, 3], poses[..., 2, 3] = x, y, z
    return poses


def random_top_down(rng, count, radius=(0.35, 0.80), height=(0.03, 0.3)):
    """Anywhere around the base, within these distances from its axis and these heights, turned anyhow."""
    r, z = rng.uniform(*radius, count), rng.uniform(*height, count)
    azimuth, yaw = rng.uniform(-np.pi, np.pi, (2, count))
    return top_down(r * np.cos(azimuth), r * np.sin(azimuth), z, yaw)


def beyond_the_panda(poses):
    """How much further than the Panda's arm is long its wrist must be for top-down tool poses (N, 4, 4), in metres.

    Trigonometry alone: the wrist stands 0.107 + 0.105 m above the tool and, at best, 0.088 m nearer to the base's axis;
    the shoulder is 0.333 m above the ground; upper arm and forearm are longest in one line through the elbow's axis.
    """
    longest = np.hypot(0.316, 0.0825) + np.hypot(0.384, 0.0825)
    across = np.hypot(poses[:, 0, 3], poses[:, 1, 3]) - 0.088
    return np.hypot(across, poses[:, 2, 3] + 0.107 + 0.105 - 0.333) - longest
