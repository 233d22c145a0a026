"""Small problems in the plane, and how to carry out actions in them without the loop."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from llm3.interfaces import PlannerSettings
from llm3.types import Action, Failure, Motion, MotionProblem, NoMotion, PlannedAction, State
from llm3_birrt.planner import BiRRT
from llm3_tabletop2d.domain import Tabletop2D
from llm3_tabletop2d.env import TabletopEnv
from llm3_tabletop2d.instance import GoalSpec, ObjectSpec, RectangleSpec, TabletopInstance

RADIUS = 0.03
DOMAIN = Tabletop2D()


def disc(name: str, x: float, y: float, diameter: float = 0.08) -> ObjectSpec:
    return ObjectSpec(name, "disc", (diameter, diameter), (x, y))


def box(name: str, x: float, y: float, size: tuple[float, float] = (0.08, 0.06), theta: float = 0.0) -> ObjectSpec:
    return ObjectSpec(name, "box", size, (x, y), theta)


def wall(name: str, x: float, y: float, dx: float, dy: float) -> RectangleSpec:
    return RectangleSpec(name, (x, y), (dx, dy))


def problem(*objects: ObjectSpec, walls: tuple[RectangleSpec, ...] = (), robot=(0.1, 0.4)) -> TabletopInstance:
    """The first of the objects belongs in a tray at the right-hand end of the room."""
    tray = RectangleSpec("tray", (1.05, 0.4), (0.2, 0.4))
    return TabletopInstance((1.2, 0.8), robot, objects, (tray,), (GoalSpec(objects[0].name, "tray"),), walls)


def world(*objects: ObjectSpec, walls: tuple[RectangleSpec, ...] = (), radius: float = RADIUS) -> TabletopEnv:
    return TabletopEnv(problem(*objects, walls=walls), radius)


def pick(name: str, angle: float = 3.14) -> Action:
    return Action("pick", (name,), {"angle": angle})


def place(name: str, x: float, y: float) -> Action:
    return Action("place", (name,), {"x": x, "y": y})


def push(name: str, x: float, y: float) -> Action:
    return Action("push", (name,), {"x": x, "y": y})


def asked(env: TabletopEnv, state: State, action: Action) -> MotionProblem | NoMotion | Failure:
    return env.prepare(state, action, np.random.default_rng(0))


def refused(env: TabletopEnv, state: State, action: Action) -> Failure:
    answer = asked(env, state, action)
    assert isinstance(answer, Failure), answer
    return answer


def done(env: TabletopEnv, state: State, *actions: Action) -> tuple[PlannedAction, ...]:
    """How a sequence of possible actions is carried out."""
    steps = []
    for action in actions:
        query = asked(env, state, action)
        motion = Motion()
        if not isinstance(query, NoMotion):
            assert isinstance(query, MotionProblem), query
            path = BiRRT(PlannerSettings()).plan(query, np.random.default_rng(0))
            assert not isinstance(path, Failure), path
            motion = query.motion(path)
        state = env.apply(state, action, motion).state
        steps.append(PlannedAction(action, motion, state))
    return tuple(steps)


def after(env: TabletopEnv, *actions: Action) -> State:
    """Where a sequence of possible actions leads from the start."""
    return done(env, env.reset(), *actions)[-1].state


def moved(state: State, name: str, x: float, y: float) -> State:
    """The state with one object somewhere else."""
    pose = replace(state.poses[name], position=(x, y, 0.0))
    return replace(state, poses={**state.poses, name: pose})
