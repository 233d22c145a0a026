"""Outlines that are made of points, and how deep a point is inside of a thing."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
SPACING = 0.002
"""Distance of neighbouring points of an outline, in metres, at most."""


@dataclass(frozen=True)
class Outline:
    """A disc or a rectangle somewhere."""

    name: str
    disc: bool
    size: tuple[float, float]
    """Full side lengths; of a disc its diameter, twice."""
    turn: float = 0.0
    """In radians, counter-clockwise."""

    @property
    def points(self) -> Array:
        """Of its outline, seen from its centre, (N, 2)."""
        a, b = self.size[0] / 2, self.size[1] / 2
        if self.disc:
            angles = np.linspace(0, 2 * np.pi, max(8, int(2 * np.pi * a / SPACING)), endpoint=False)
            return a * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        corners = np.array([(-a, -b), (a, -b), (a, b), (-a, b), (-a, -b)])
        sides = [np.linspace(p, q, int(np.ceil(np.abs(q - p).sum() / SPACING)) + 1) for p, q in pairwise(corners)]
        return np.concatenate(sides) @ _rotation(self.turn).T

    def depth(self, points: Array) -> Array:
        """How deep points (…, 2), seen from its centre, are inside of it, in metres; outside, minus the distance."""
        if self.disc:
            return np.asarray(self.size[0] / 2 - np.linalg.norm(points, axis=-1))
        beyond = np.abs(points @ _rotation(self.turn)) - np.array(self.size) / 2
        outside = np.linalg.norm(np.maximum(beyond, 0.0), axis=-1)
        return np.asarray(np.where(outside > 0, -outside, -beyond.max(axis=-1)))


def deepest(one: Outline, other: Outline, offsets: Array) -> Array:
    """How deep two things are in one another, (N,), in metres; apart, minus their distance, as far as the points tell.

    Args:
        one: A thing.
        other: Another one.
        offsets: From the centre of the first to that of the second, (N, 2).
    """
    mine = other.depth(one.points - offsets[:, None]).max(axis=1)
    its = one.depth(other.points + offsets[:, None]).max(axis=1)
    return np.asarray(np.maximum(mine, its))


def _rotation(turn: float) -> Array:
    c, s = np.cos(turn), np.sin(turn)
    return np.array([(c, -s), (s, c)])
