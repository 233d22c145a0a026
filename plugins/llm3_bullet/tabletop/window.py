"""A tabletop to look at."""

from __future__ import annotations

from collections.abc import Callable
from time import sleep

import numpy as np

from llm3.interfaces import Env, Joint
from llm3.types import (
    Action,
    ActionSchema,
    Entity,
    Failure,
    GoalStatus,
    Motion,
    MotionProblem,
    NoMotion,
    State,
    Transition,
)
from llm3_bullet.clients import BulletClient
from llm3_bullet.stage import Camera, Color, Stage
from llm3_bullet.tabletop.env import TabletopEnv

COLORS: dict[str, Color] = {
    "table": (0.90, 0.86, 0.80),
    "basket": (0.45, 0.33, 0.22),
    "red": (0.83, 0.20, 0.18),
    "blue": (0.16, 0.38, 0.75),
    "green": (0.20, 0.58, 0.32),
    "tan": (0.86, 0.70, 0.47),
    "cyan": (0.20, 0.70, 0.75),
    "yellow": (0.92, 0.78, 0.20),
    "orange": (0.90, 0.49, 0.13),
    "purple": (0.49, 0.27, 0.62),
}
"""By the first word of a name."""
GREY: Color = (0.6, 0.6, 0.6)
CAMERA = Camera(target=(0.36, 0.0, 0.22), distance=1.35, yaw=55.0, pitch=-30.0)
LAST_LOOK = 2.0
"""Seconds for which the window stays open at the end."""


def color_of(name: str) -> Color:
    """The colour that a name begins with, or grey."""
    return COLORS.get(name.partition("_")[0], GREY)


class WindowEnv(Env):
    """Another Env, which plays in a window what it applies."""

    def __init__(self, env: TabletopEnv, client: BulletClient, pause: Callable[[float], None] = sleep) -> None:
        """Open the curtain.

        Args:
            env: The world; it is this Env's to close from now on, and so is the client.
            client: A simulator of its own, with a window.
            pause: Waits for some seconds, between two frames.
        """
        self._env = env
        names = (box.name for box in env.scene(env.reset()).boxes)
        colors = {name: env.colors.get(name, color_of(name)) for name in names}
        self._stage = Stage(client, env.tabletop.workcell.model, colors, CAMERA, pause)
        self._show(env.reset())

    def _show(self, state: State) -> None:
        scene = self._env.scene(state)
        self._stage.show(scene.boxes, state.configuration, state.held, scene.opening)

    def apply(self, state: State, action: Action, motion: Motion) -> Transition:
        """The same as without a window, after the motion was played."""
        transition = self._env.apply(state, action, motion)
        self._show(state)
        self._stage.play(motion)
        self._show(transition.state)
        return transition

    def close(self) -> None:
        """Leave the window open for a last look, and stop the simulators."""
        self._stage.close(LAST_LOOK)
        self._env.close()

    # ---- as without a window --------------------------------------------------------------------------

    @property
    def task(self) -> str:
        """The task in prose."""
        return self._env.task

    @property
    def schemas(self) -> tuple[ActionSchema, ...]:
        """The primitive actions."""
        return self._env.schemas

    @property
    def objects(self) -> tuple[str, ...]:
        """The boxes."""
        return self._env.objects

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The arm's joints."""
        return self._env.joints

    def reset(self) -> State:
        """The initial state."""
        return self._env.reset()

    def describe(self, state: State) -> tuple[Entity, ...]:
        """The state as the model reads it."""
        return self._env.describe(state)

    def prepare(self, state: State, action: Action, rng: np.random.Generator) -> MotionProblem | NoMotion | Failure:
        """What motion the action needs."""
        return self._env.prepare(state, action, rng)

    def goal(self, state: State) -> GoalStatus:
        """Whether the goal is reached."""
        return self._env.goal(state)
