"""A small kitchen, and how to carry out actions in it without the loop."""

from __future__ import annotations

import numpy as np

from llm3.interfaces import Env, PlannerSettings
from llm3.types import Action, Failure, Motion, MotionProblem, NoMotion, Path, PlannedAction, State
from llm3_birrt.planner import BiRRT
from llm3_kitchen.instance import ClutterSpec, FoodSpec, KitchenInstance
from llm3_kitchen.meals import PLACES

CARROT = FoodSpec("carrot", (0.12, 0.03, 0.03), (0.6, -0.2), washed=True, heated=True)
POTATO = FoodSpec("potato", (0.05, 0.05, 0.045), (0.6, 0.2), washed=True)
BREAD = FoodSpec("bread", (0.1, 0.065, 0.06), (0.6, 0.0))
BOTTLE = ClutterSpec("oil_bottle", (0.045, 0.045, 0.16), (0.6, -0.157))
"""It stands 5 mm beside the carrot."""
KITCHEN = KitchenInstance(PLACES, (CARROT, POTATO, BREAD), (BOTTLE,))
SINK, STOVE, SERVING, WORKTOP = (0.38, 0.38), (0.38, -0.38), (-0.02, 0.56), (-0.02, -0.56)
"""The centres of the places of the settings."""


def pick(name: str) -> Action:
    return Action("pick", (name,))


def place(name: str, where: str, spot: tuple[float, float], theta: float = 0.0) -> Action:
    return Action("place", (name, where), {"x": spot[0], "y": spot[1], "theta": theta})


def wash(name: str) -> Action:
    return Action("wash", (name,))


def heat(name: str) -> Action:
    return Action("heat", (name,))


def refused(env: Env, state: State, action: Action) -> Failure:
    """Why an action is impossible."""
    answer = env.prepare(state, action, np.random.default_rng(0))
    assert isinstance(answer, Failure), answer
    return answer


def planned(env: Env, state: State, *actions: Action) -> list[PlannedAction]:
    """A sequence of possible actions, and how each of them is done."""
    steps = []
    for action in actions:
        rng = np.random.default_rng(0)
        answer = env.prepare(state, action, rng)
        motion = Motion()
        if not isinstance(answer, NoMotion):
            assert isinstance(answer, MotionProblem), answer
            path = BiRRT(PlannerSettings()).plan(answer, rng)
            assert isinstance(path, Path), path
            motion = answer.motion(path)
        state = env.apply(state, action, motion).state
        steps.append(PlannedAction(action, motion, state))
    return steps


def after(env: Env, state: State, *actions: Action) -> State:
    """Where a sequence of possible actions leads."""
    steps = planned(env, state, *actions)
    return steps[-1].state if steps else state
