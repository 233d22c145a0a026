"""Registers OMPL's planners; OMPL itself is imported when one of them is made.

What is not here cannot keep a planner's contract: OMPL's PRM searches in a second thread and by the clock, its RRT* has
given different paths from one seed, and its AORRTC can enter a search that neither iterations nor a clock end.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib.util import find_spec

from llm3.errors import MissingDependency
from llm3.hookspecs import hookimpl
from llm3.interfaces import MotionPlanner, PlannerSettings


@hookimpl
def llm3_planners() -> Mapping[str, Callable[[PlannerSettings], MotionPlanner]]:
    """The planners of this package."""
    return {"ompl-rrtconnect": _rrtconnect, "ompl-lbkpiece": _lbkpiece, "ompl-bitstar": _bitstar}


def _rrtconnect(settings: PlannerSettings) -> MotionPlanner:
    """OMPL's RRT-Connect: a first path soon; the choice where nothing speaks for another."""
    return _planner("ompl-rrtconnect", "RRTConnect", settings)


def _lbkpiece(settings: PlannerSettings) -> MotionPlanner:
    """OMPL's LBKPIECE: tests the edges of candidate paths only, at the price of more iterations."""
    return _planner("ompl-lbkpiece", "LBKPIECE1", settings)


def _bitstar(settings: PlannerSettings) -> MotionPlanner:
    """OMPL's BIT*: spends all its iterations on a shorter path."""
    return _planner("ompl-bitstar", "BITstar", settings)


def _planner(name: str, algorithm: str, settings: PlannerSettings) -> MotionPlanner:
    if find_spec("ompl") is None:
        raise MissingDependency(
            f"the planner {name!r} needs a package that is not installed: pip install 'llm3[ompl]'."
        )
    from llm3_ompl.planner import OMPLPlanner

    return OMPLPlanner(algorithm, settings)
