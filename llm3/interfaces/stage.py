"""Where a domain shows what happens."""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np
from numpy.typing import NDArray

from llm3.types import Moment

Picture = NDArray[np.uint8]
"""Red, green and blue, 0 to 255, of each pixel: shape (height, width, 3)."""


class Stage(ABC):
    """Shows what is where, in a window or as pictures.

    Nothing is planned or checked on it, so that drawing can neither slow planning down nor change it.
    """

    @abstractmethod
    def show(self, moment: Moment) -> None:
        """Show a moment; what it does not mention is not shown."""

    @abstractmethod
    def picture(self, width: int, height: int) -> Picture:
        """What is shown, as a picture of so many pixels."""

    def close(self) -> None:  # most stages have nothing to let go of
        """Let go of whatever it holds, such as a window. Calling it twice does no harm."""
