"""An Env around a tabletop: what is the same in all of them."""

from __future__ import annotations

from collections.abc import Mapping

from llm3.interfaces import Env, Joint
from llm3.types import Action, Camera, Color, FrozenDict, Motion, State, Transition
from llm3_bullet.scene import Box, Scene
from llm3_bullet.tabletop.looks import CAMERA
from llm3_bullet.tabletop.tabletop import Tabletop


class TabletopEnv(Env):
    """Boxes on a table and an arm, with a simulator as a cache of the state.

    A subclass adds the task, the actions and what each of them needs, the description of a state, and the goal.
    """

    colors: Mapping[str, Color] = FrozenDict()
    """Of things in pictures, by name; others have the colour that their name begins with, or are grey."""
    camera: Camera = CAMERA
    """Where pictures are taken from."""
    marks: tuple[Box, ...] = ()
    """What is marked on the table, and only there to be seen."""

    def __init__(self, tabletop: Tabletop) -> None:
        """Bind a tabletop; the Env owns its workcell from now on."""
        self.tabletop = tabletop

    @property
    def objects(self) -> tuple[str, ...]:
        """The boxes."""
        return tuple(self.tabletop.sizes)

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The arm's joints."""
        return self.tabletop.joints

    def reset(self) -> State:
        """The boxes at their start, the arm at home."""
        return self.tabletop.start

    def apply(self, state: State, action: Action, motion: Motion) -> Transition:  # noqa: ARG002  # the motion tells
        """The box in the hand after a pick, and let go after a place; the others as physics leaves them."""
        return self.tabletop.after(state, motion)

    def scene(self, state: State) -> Scene:
        """Everything that surrounds the robot in a state."""
        return self.tabletop.scene(state)

    def close(self) -> None:
        """Stop the simulators."""
        self.tabletop.workcell.close()
