"""Paths of a real arm keep their promise: nothing is touched, not even between the samples that were tested."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np
import pytest

from llm3.interfaces import PlannerSettings
from llm3.types import Failure, FailureKind, Goal, MotionProblem, Path, Pose, Vector
from llm3_birrt.planner import BiRRT
from llm3_bullet.robots.panda import panda
from llm3_bullet.scene import Box, HeldBox, Scene
from llm3_bullet.workcell import Workcell

pytestmark = pytest.mark.pybullet

CLEARANCE = 0.005
"""Metres."""
TABLE = Box("table", (1.2, 2.0, 0.1), Pose((0.5, 0.0, -0.05)), fixed=True)
WALL = Box("wall", (0.5, 0.03, 0.5), Pose((0.5, 0.0, 0.25)), fixed=True)
"""It stands between the arm's left and its right."""
CARGO = HeldBox("cargo", (0.07, 0.07, 0.07), Pose((0.0, 0.0, 0.02)))


@pytest.fixture(scope="module")
def cell() -> Iterator[Workcell]:
    cell = Workcell(panda())
    yield cell
    cell.close()


def problem_of(cell: Workcell, scene: Scene, start: Vector, *goals: Vector) -> MotionProblem:
    view = cell.checker.view(scene)
    return MotionProblem(
        start,
        tuple(Goal(tuple(goal)) for goal in goals),
        cell.model.low,
        cell.model.high,
        valid=lambda configurations: view.valid(configurations, CLEARANCE),
        resolution=view.resolution(CLEARANCE),
        explain=lambda configuration: view.contacts(configuration, CLEARANCE),
    )


def beside(cell: Workcell, scene: Scene, side: int, rng: np.random.Generator) -> Vector:
    """A free configuration with the hand low beside the wall, to the left (1) or to the right (-1) of it."""
    view = cell.checker.view(scene)
    while True:
        candidates = rng.uniform(cell.model.low, cell.model.high, (2000, cell.model.dof))
        x, y, z = cell.kinematics.tool(candidates)[:, :3, 3].T
        near = (x > 0.3) & (x < 0.7) & (side * y > 0.05) & (z > 0.1) & (z < 0.4)
        for candidate in candidates[near]:
            if view.valid(candidate[None], CLEARANCE)[0]:
                return candidate


def sampled(problem: MotionProblem, path: Path, finer: int) -> Vector:
    pieces = [path.waypoints[:1]]
    for start, end in pairwise(path.waypoints):
        steps = max(1, int(np.ceil(finer * (np.abs(end - start) / problem.resolution).sum())))
        pieces.append(start + (end - start) * (np.arange(1, steps + 1) / steps)[:, None])
    return np.vstack(pieces)


def planned(cell: Workcell, scene: Scene, seed: int) -> tuple[MotionProblem, Path | Failure]:
    rng = np.random.default_rng(seed)
    problem = problem_of(cell, scene, beside(cell, scene, 1, rng), beside(cell, scene, -1, rng))
    return problem, BiRRT(PlannerSettings(max_seconds=np.inf)).plan(problem, rng)


@pytest.mark.parametrize("held", [None, CARGO])
@pytest.mark.parametrize("seed", [*range(3), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(3, 40))])
def test_a_path_touches_nothing_between_its_samples_either(cell: Workcell, held: HeldBox | None, seed: int) -> None:
    scene = Scene((TABLE, WALL), held, 0.07)
    problem, path = planned(cell, scene, seed)
    assert isinstance(path, Path)
    assert problem.valid(sampled(problem, path, finer=1)).all()
    assert cell.checker.view(scene).valid(sampled(problem, path, finer=8)).all()


def test_a_search_that_fails_names_the_walls(cell: Workcell) -> None:
    size = (0.04, 1.0, 2.0)
    walls = (Box("left wall", size, Pose((0.0, 0.65, 1.0))), Box("right wall", size, Pose((0.0, -0.65, 1.0))))
    scene = Scene((TABLE, *walls), None, 0.07)
    ahead = cell.model.home
    behind = ahead + np.array([2.8, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    problem = problem_of(cell, scene, ahead, behind)
    failure = BiRRT(PlannerSettings(max_iterations=30)).plan(problem, np.random.default_rng(0))
    assert isinstance(failure, Failure)
    assert failure.kind is FailureKind.NO_PATH
    assert set(failure.objects[:2]) == {"left wall", "right wall"}
    assert failure.measures["hit_share"] > 0.3
    assert {contact.part for contact in failure.contacts} <= {"arm", "gripper"}
    assert not problem.valid(np.array([failure.configuration]))[0]
