"""Which links of a robot may touch each other, and for which joint positions they cannot."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.reach import joints_below, reach

Array = NDArray[np.float64]
Pair = tuple[int, int]
"""Two links by their numbers in the model, the smaller number first."""
Distance = Callable[[Array, Pair], float]
"""The distance in metres between two links in a configuration (dof,), or a lower bound of it."""
EDGE = 1e-6
"""How far beyond a limit the tables still say something, in radians or metres."""


def link_pairs(model: RobotModel, solid: Sequence[int]) -> tuple[Pair, ...]:
    """The pairs of links whose contact is a collision.

    Left out are links that a joint connects, links that no joint moves against each other, the parts of the gripper
    among themselves, which closes on itself, and the pairs that the description lets touch.

    Args:
        model: The robot.
        solid: The links that have a collision shape.
    """
    gripper = {model.link(name) for name in model.description.gripper.links}
    allowed = {tuple(sorted(map(model.link, pair))) for pair in model.description.may_touch}
    rigid = list(range(len(model.links)))  # a name for the links that no joint moves against each other
    for link, joint in enumerate(model.joints, start=1):
        if joint.type == "fixed":
            rigid[link] = rigid[model.parents[link]]
    return tuple(
        (a, b)
        for a in sorted(solid)
        for b in sorted(solid)
        if a < b and rigid[a] != rigid[b] and a != model.parents[b] and not {a, b} <= gripper and (a, b) not in allowed
    )


class NeighbourClearance:
    """Lower bounds of the distance between links that are at most two arm joints apart.

    Such links are near each other always, and no coarse shape tells them apart. But their distance is a function of
    two numbers, and it changes with a joint no faster than the farther link's points travel: so a grid over the two
    joints, one exact distance a cell, bounds it everywhere. Cells are refined where the bound is too low to help.
    """

    def __init__(
        self,
        kinematics: Kinematics,
        hulls: Sequence[Array],
        pairs: Sequence[Pair],
        distance: Distance,
        cells: int = 256,
        enough: float = 0.006,
    ) -> None:
        """Fill the grids.

        Args:
            kinematics: The robot.
            hulls: For each link points (V, 3) whose convex hull covers it.
            pairs: All pairs of interest; those that the tables can say something about become `pairs`.
            distance: Exact distances.
            cells: Cells along a joint's range, a power of two.
            enough: A bound in metres beyond which a cell is not refined.
        """
        model = kinematics.model
        below = joints_below(model)
        sliding = _moved_by_fingers(model)
        self.pairs = tuple((a, b) for a, b in pairs if 1 <= abs(below[b] - below[a]) <= 2 and not {a, b} & sliding)
        # A hair wider than the limits, so that whatever counts as within them has a cell.
        self._low = model.low - EDGE
        self._widths = (model.high + EDGE - self._low) / cells
        self._cells = cells
        first = np.array([min(below[a], below[b]) for a, b in self.pairs], dtype=np.intp)
        second = np.array([max(below[a], below[b]) - 1 for a, b in self.pairs], dtype=np.intp)
        tables = np.full((len(self.pairs), cells, cells), np.inf, dtype=np.float32)
        for table, pair, i, j in zip(tables, self.pairs, first.tolist(), second.tolist(), strict=True):
            farther = max(pair, key=below.__getitem__)
            far = [hull if link == farther else np.empty((0, 3)) for link, hull in enumerate(hulls)]
            speed = reach(kinematics, far, 0.0)[[i, j]] * self._widths[[i, j]]
            if i == j:
                speed[1] = 0.0
            self._fill(table, model.home, pair, (i, j), speed, distance, enough)
        self.least = dict(zip(self.pairs, tables.min(axis=(1, 2)).tolist(), strict=True))
        """A lower bound of each pair's distance in metres, whatever the joints do."""
        self._bounds = tables.ravel()
        numbers = np.arange(len(self.pairs))
        self._offsets = numbers * (cells * cells)
        self._strides = np.zeros((model.dof, len(self.pairs)))
        self._strides[first, numbers] += cells
        self._strides[second, numbers] += 1

    def bounds(self, Q: Array) -> NDArray[np.float32]:
        """A lower bound of each pair's distance, (N, P) in metres, for configurations (N, dof) within the limits."""
        cells = np.floor((Q - self._low) / self._widths)
        found: NDArray[np.float32] = self._bounds[(cells @ self._strides + self._offsets).astype(np.intp)]
        return found

    def _fill(
        self,
        table: NDArray[np.float32],
        home: Array,
        pair: Pair,
        joints: tuple[int, int],
        speed: Array,
        distance: Distance,
        enough: float,
    ) -> None:
        open_ = [(0, self._cells, 0, self._cells)]
        q = home.copy()
        while open_:
            i0, i1, j0, j1 = open_.pop()
            if joints[0] == joints[1]:
                j0, j1 = i0, i1
            for joint, middle in zip(joints, ((i0 + i1) / 2, (j0 + j1) / 2), strict=True):
                q[joint] = self._low[joint] + middle * self._widths[joint]
            slack = (i1 - i0) / 2 * speed[0] + (j1 - j0) / 2 * speed[1]
            middle_distance = distance(q, pair)
            bound = middle_distance - slack
            if bound > enough or middle_distance + slack < 0 or i1 - i0 == 1:
                table[i0:i1, j0:j1] = bound
                continue
            i, j = (i0 + i1) // 2, (j0 + j1) // 2
            quarters = [(i0, i, j0, j), (i, i1, j, j1)]
            if joints[0] != joints[1]:
                quarters += [(i0, i, j, j1), (i, i1, j0, j)]
            open_ += quarters


def _moved_by_fingers(model: RobotModel) -> set[int]:
    """The links that move when the gripper opens."""
    fingers = set(model.finger_joints)
    moved: set[int] = set()
    for link, parent in enumerate(model.parents[1:], start=1):
        if link - 1 in fingers or parent in moved:
            moved.add(link)
    return moved
