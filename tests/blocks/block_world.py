"""Small problems of towers, and how to carry out actions in them without the loop."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from llm3.interfaces import Env, PlannerSettings
from llm3.types import Action, Failure, Motion, MotionProblem, Path, Pose, State, Transition
from llm3_birrt.planner import BiRRT
from llm3_blocks.instance import BlocksInstance, BlockSpec, On, TowerSpec

Size = tuple[float, float, float]
CUBE = (0.05, 0.05, 0.05)


def tower(*blocks: str, at: tuple[float, float], yaw: float = 0.0) -> TowerSpec:
    return TowerSpec(blocks, at, yaw)


def problem(*towers: TowerSpec, goal: str, sizes: dict[str, Size] | None = None) -> BlocksInstance:
    """The blocks of these towers, cubes unless their sizes are given; the goal as in ``"a on b, b on table"``."""
    names = [name for tower in towers for name in tower.blocks]
    parts = (part.split(" on ") for part in goal.split(", "))
    return BlocksInstance(
        tuple(BlockSpec(name, (sizes or {}).get(name, CUBE)) for name in names),
        towers,
        tuple(On(block, below) for block, below in parts),
    )


def pick(name: str) -> Action:
    return Action("pick", (name,))


def place(name: str, x: float, y: float, theta: float = 0.0) -> Action:
    return Action("place", (name,), {"x": x, "y": y, "theta": theta})


def stack(name: str, below: str) -> Action:
    return Action("stack", (name, below))


def refused(env: Env, state: State, action: Action, seed: int = 0) -> Failure:
    """Why an action is impossible."""
    answer = env.prepare(state, action, np.random.default_rng(seed))
    assert isinstance(answer, Failure), answer
    return answer


def carried_out(env: Env, state: State, action: Action, seed: int = 0) -> tuple[Motion, Transition]:
    """The motion and the transition of an action that is possible."""
    query = env.prepare(state, action, np.random.default_rng(seed))
    assert isinstance(query, MotionProblem), query
    path = BiRRT(PlannerSettings()).plan(query, np.random.default_rng(seed))
    assert isinstance(path, Path), path
    motion = query.motion(path)
    return motion, env.apply(state, action, motion)


def after(env: Env, state: State, *actions: Action) -> State:
    """Where a sequence of possible actions leads."""
    for action in actions:
        state = carried_out(env, state, action)[1].state
    return state


def moved(state: State, name: str, x: float, y: float, z: float) -> State:
    """The state with one block somewhere else, its sides along the world's axes."""
    return replace(state, poses={**state.poses, name: Pose((x, y, z))})
