"""Forty motion queries of box packing, the same for every planner; `choose_queries` tells where they come from."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from llm3.jsonio import read_file
from llm3.types import Goal, MotionProblem
from llm3_bullet.scene import Scene
from llm3_bullet.tabletop.tabletop import CLEARANCE
from llm3_bullet.workcell import Workcell

FILE = Path(__file__).with_name("queries.json")


@dataclass(frozen=True)
class Query:
    """One transit: from where the arm is to above a box, or above a place for the box in its gripper."""

    setting: str
    seed: int
    action: str
    scene: Scene
    start: tuple[float, ...]
    goal: tuple[float, ...]
    """The one that the Env prefers."""
    winding: bool
    """Whether the straight line is blocked, so that a tree is needed."""

    def problem(self, cell: Workcell) -> MotionProblem:
        """The query as a planner gets it."""
        view = cell.checker.view(self.scene)
        return MotionProblem(
            np.array(self.start),
            (Goal(self.goal),),
            cell.model.low,
            cell.model.high,
            valid=lambda configurations: view.valid(configurations, CLEARANCE),
            resolution=view.resolution(CLEARANCE),
            uncertain=lambda start, end, steps: view.uncertain(start, end, steps, CLEARANCE),
            explain=lambda configuration: view.contacts(configuration, CLEARANCE),
        )


@dataclass(frozen=True)
class Queries:
    """The chosen queries, and how many there were to choose from."""

    met: dict[str, int]
    """Transits by stratum, as `choose_queries.stratum` calls them."""
    chosen: tuple[Query, ...]


def queries() -> Queries:
    """The queries that were chosen."""
    return read_file(FILE, Queries)
