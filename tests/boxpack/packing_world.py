"""Small box-packing problems, and how to carry out actions in them without the loop."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from llm3.interfaces import Env, PlannerSettings
from llm3.types import Action, Failure, Motion, MotionProblem, Path, Pose, State, Transition
from llm3_birrt.planner import BiRRT
from llm3_boxpack.instance import BasketSpec, BoxpackInstance, BoxSpec
from llm3_bullet.poses import Array, as_pose

CUBE, POST, BAR = (0.07, 0.07, 0.07), (0.035, 0.035, 0.07), (0.105, 0.035, 0.07)
BASKET = BasketSpec((0.65, 0.0), (0.22, 0.21))


def box(name: str, x: float, y: float, size: tuple[float, float, float] = CUBE, yaw: float = 0.0) -> BoxSpec:
    return BoxSpec(name, size, (x, y), yaw)


def problem(*boxes: BoxSpec, basket: BasketSpec = BASKET) -> BoxpackInstance:
    return BoxpackInstance(basket, boxes)


def pick(name: str) -> Action:
    return Action("pick", (name,))


def place(name: str, x: float, y: float, theta: float = 0.0) -> Action:
    return Action("place", (name,), {"x": x, "y": y, "theta": theta})


def prepared(env: Env, state: State, action: Action, seed: int = 0) -> MotionProblem:
    """What the Env asks of the planner, for an action that is possible."""
    answer = env.prepare(state, action, np.random.default_rng(seed))
    assert isinstance(answer, MotionProblem), answer
    return answer


def refused(env: Env, state: State, action: Action, seed: int = 0) -> Failure:
    """Why an action is impossible."""
    answer = env.prepare(state, action, np.random.default_rng(seed))
    assert isinstance(answer, Failure), answer
    return answer


def carried_out(env: Env, state: State, action: Action, seed: int = 0) -> tuple[Motion, Transition]:
    """The motion and the transition of an action that is possible."""
    query = prepared(env, state, action, seed)
    path = BiRRT(PlannerSettings()).plan(query, np.random.default_rng(seed))
    assert isinstance(path, Path), path
    motion = query.motion(path)
    return motion, env.apply(state, action, motion)


def after(env: Env, state: State, *actions: Action) -> State:
    """Where a sequence of possible actions leads."""
    for action in actions:
        state = carried_out(env, state, action)[1].state
    return state


def moved(state: State, name: str, x: float, y: float, z: float, orientation: Array | None = None) -> State:
    """The state with one box somewhere else; `orientation` is (3, 3)."""
    matrix = np.eye(4)
    matrix[:3, :3] = np.eye(3) if orientation is None else orientation
    matrix[:3, 3] = x, y, z
    return replace(state, poses={**state.poses, name: as_pose(matrix)})


def standing(name_to_xy: dict[str, tuple[float, float]], z: float = 0.045) -> State:
    """Boxes upright at these places, and nothing of the robot: enough for the goal."""
    return State({name: Pose((x, y, z)) for name, (x, y) in name_to_xy.items()})
