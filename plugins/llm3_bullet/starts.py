"""Where inverse kinematics starts from."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from llm3_bullet.kinematics import Kinematics

Array = NDArray[np.float64]

_ENTRIES = 2**15
_BATCH = 2**10  # so many poses are computed at once: what they need fits into a processor's cache
_SEED = 0
_METRES = 0.5  # what a rotation counts for: the length of the levers whose ends are compared


class StartTable:
    """Configurations whose tool poses are known, to start from those that are close already.

    The configurations are uniform within the joint limits and the same in every process. Making the table takes some
    50 ms.
    """

    def __init__(self, kinematics: Kinematics) -> None:
        model = kinematics.model
        self._configurations = np.random.default_rng(_SEED).uniform(model.low, model.high, (_ENTRIES, model.dof))
        batches = np.split(self._configurations, _ENTRIES // _BATCH)
        self._tree = cKDTree(np.concatenate([_features(kinematics.tool(batch)) for batch in batches]))

    def nearest(self, targets: Array, count: int) -> Array:
        """The `count` configurations whose tool poses are closest to each target (B, 4, 4): (B, count, dof)."""
        _, found = self._tree.query(_features(targets), k=np.arange(1, count + 1))
        nearest: Array = self._configurations[found]
        return nearest


def _features(poses: Array) -> Array:
    """Poses as points whose distance is small where the poses are alike: (B, 9)."""
    levers = _METRES * poses[:, :3, :2]  # two axes tell the third
    return np.concatenate([poses[:, :3, 3], levers.reshape(-1, 6)], axis=1)
