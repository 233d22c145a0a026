"""Registers the timer ``toppra``."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib.util import find_spec

from llm3.errors import MissingDependency
from llm3.hookspecs import hookimpl
from llm3.interfaces import TrajectoryTimer


@hookimpl
def llm3_timers() -> Mapping[str, Callable[[], TrajectoryTimer]]:
    """The timer of this package."""
    return {"toppra": _toppra}


def _toppra() -> TrajectoryTimer:
    """As fast as the limits of velocity and acceleration allow, by reachability analysis; stops at corners."""
    if find_spec("toppra") is None:
        raise MissingDependency("the timer 'toppra' needs a package that is not installed: pip install 'llm3[time]'.")
    from llm3_time.timer import ToppraTimer

    return ToppraTimer()
