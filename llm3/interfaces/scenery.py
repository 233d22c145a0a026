"""What a domain looks like, in three dimensions."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from llm3.types import Body, Camera, Moment

Frame = NDArray[np.float64]
"""A pose as a homogeneous matrix, shape (4, 4)."""


class Scenery(ABC):
    """The bodies of one problem, and where they are at any moment: for replays, reports and whatever else draws.

    It holds no simulator, so that it can be kept as long as anybody likes.
    """

    @property
    @abstractmethod
    def bodies(self) -> tuple[Body, ...]:
        """Everything that there is to see, each with a name of its own."""

    @property
    def camera(self) -> Camera:
        """Where one looks from at first."""
        return Camera()

    @abstractmethod
    def places(self, moment: Moment) -> Mapping[str, Frame]:
        """Where the bodies are, by name, in the world frame; a body that is left out is not to be seen then."""
