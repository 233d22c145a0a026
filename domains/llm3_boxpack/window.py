"""The box-packing world to look at."""

from __future__ import annotations

from collections.abc import Callable
from time import sleep

from llm3.types import Action, Motion, State, Transition
from llm3_boxpack.env import BoxpackEnv
from llm3_boxpack.instance import BoxpackInstance
from llm3_bullet.clients import BulletClient
from llm3_bullet.model import RobotModel
from llm3_bullet.stage import Camera, Color, Stage
from llm3_bullet.workcell import Workcell

COLORS: dict[str, Color] = {
    "table": (0.90, 0.86, 0.80),
    "basket": (0.45, 0.33, 0.22),
    "red": (0.83, 0.20, 0.18),
    "blue": (0.16, 0.38, 0.75),
    "green": (0.20, 0.58, 0.32),
    "tan": (0.86, 0.70, 0.47),
    "cyan": (0.20, 0.70, 0.75),
    "yellow": (0.92, 0.78, 0.20),
}
"""By the first word of a name."""
GREY: Color = (0.6, 0.6, 0.6)
CAMERA = Camera(target=(0.36, 0.0, 0.22), distance=1.35, yaw=55.0, pitch=-30.0)
LAST_LOOK = 2.0
"""Seconds for which the window stays open at the end."""


def color_of(name: str) -> Color:
    """The colour that a name begins with, or grey."""
    return COLORS.get(name.partition("_")[0], GREY)


class BoxpackStage:
    """Draws states of one instance, and plays motions between them."""

    def __init__(
        self, env: BoxpackEnv, client: BulletClient, model: RobotModel, pause: Callable[[float], None] = sleep
    ) -> None:
        """Set the stage for an Env's instance in a client of its own."""
        self._env = env
        names = [box.name for box in env.scene(env.reset()).boxes]
        colors = {name: color_of(name) for name in names}
        self.stage = Stage(client, model, colors, CAMERA, pause)
        self.show(env.reset())

    def show(self, state: State) -> None:
        """Show a state."""
        scene = self._env.scene(state)
        self.stage.show(scene.boxes, state.configuration, state.held, scene.opening)


class WindowEnv(BoxpackEnv):
    """A BoxpackEnv that plays in a window what it applies."""

    def __init__(
        self,
        instance: BoxpackInstance,
        workcell: Workcell,
        wall_height: float,
        client: BulletClient,
        pause: Callable[[float], None] = sleep,
    ) -> None:
        """Open the curtain; see `BoxpackEnv`. The Env owns the client from now on."""
        super().__init__(instance, workcell, wall_height)
        self._stage = BoxpackStage(self, client, workcell.model, pause)

    def apply(self, state: State, action: Action, motion: Motion) -> Transition:
        """The same as without a window, after the motion was played."""
        transition = super().apply(state, action, motion)
        self._stage.show(state)
        self._stage.stage.play(motion)
        self._stage.show(transition.state)
        return transition

    def close(self) -> None:
        """Leave the window open for a last look, and stop the simulators."""
        self._stage.stage.close(LAST_LOOK)
        super().close()
