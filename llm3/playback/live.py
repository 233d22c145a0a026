"""Shows a run while it happens."""

from __future__ import annotations

from collections.abc import Callable
from time import sleep
from types import TracebackType

from llm3.interfaces import Stage
from llm3.playback.frames import frames
from llm3.types import ActionTried, RunEvent, RunStarted, moment_of

RATE = 60.0
"""Frames a second."""
LAST_LOOK = 2.0
"""Seconds for which a window stays open at the end."""


class Live:
    """An observer that plays on a stage what is carried out. Close it, or use it in a ``with``.

    An action is played when it is first found feasible. Of one that is known, only where it leads is shown.
    """

    def __init__(self, stage: Stage, pause: Callable[[float], None] = sleep) -> None:
        """Open the curtain.

        Args:
            stage: It is this object's to close from now on.
            pause: Waits for some seconds.
        """
        self._stage, self._pause = stage, pause

    def __call__(self, event: RunEvent) -> None:
        """Show one event."""
        if isinstance(event, RunStarted):
            self._stage.show(moment_of(event.state))
        elif isinstance(event, ActionTried) and event.step and event.outcome.reused:
            self._stage.show(moment_of(event.step.state))
        elif isinstance(event, ActionTried) and event.step:
            time = 0.0
            for frame in frames(event.before, (event.step,), RATE):
                self._pause(frame.moment.time - time)
                self._stage.show(frame.moment)
                time = frame.moment.time
        elif isinstance(event, ActionTried):
            self._stage.show(moment_of(event.before))

    def close(self) -> None:
        """Leave the stage as it is for a last look, and close it."""
        self._pause(LAST_LOOK)
        self._stage.close()

    def __enter__(self) -> Live:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if error:
            self._stage.close()
        else:
            self.close()
