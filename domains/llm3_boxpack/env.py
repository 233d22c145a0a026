"""The box-packing world."""

from __future__ import annotations

import numpy as np

from llm3.types import Action, ActionSchema, Camera, Entity, Failure, GoalStatus, MotionProblem, State
from llm3_boxpack.actions import PICK, PLACE
from llm3_boxpack.goal import goal_status
from llm3_boxpack.instance import BoxpackInstance
from llm3_boxpack.layout import furniture
from llm3_boxpack.wording import describe, task_text
from llm3_bullet.tabletop.env import TabletopEnv
from llm3_bullet.tabletop.table import support_height
from llm3_bullet.tabletop.tabletop import Tabletop
from llm3_bullet.workcell import Workcell

OVERVIEW = Camera(target=(0.40, 0.0, 0.03), distance=1.65, yaw=72.0, pitch=-52.0)
"""Where all of the table that the arm reaches can be seen."""
ROW = 0.3, 0.5
"""Between these x, in metres, the boxes of the paper's settings start, which are seen well from nearer by."""


class BoxpackEnv(TabletopEnv):
    """Boxes, a basket, what is in the way, and an arm."""

    def __init__(self, instance: BoxpackInstance, workcell: Workcell, wall_height: float | None = None) -> None:
        """Set up the world.

        Args:
            instance: The problem.
            workcell: The robot and its simulators; the Env owns them from now on.
            wall_height: How high the basket's walls are, in metres; None for those of the problem.

        Raises:
            InputError: It cannot begin, or not with this robot; see `Tabletop`.
        """
        self._instance = instance.with_walls(wall_height)
        if not all(ROW[0] <= thing.position[0] <= ROW[1] for thing in instance.things):
            self.camera = OVERVIEW
        basket = self._instance.basket
        floors = (basket.floor,)
        things = (thing.standing(support_height(floors, thing.footprint)) for thing in instance.things)
        to_move = instance.to_move
        to_reach = ("basket",) if to_move else ()
        areas = {"basket": basket.area}
        super().__init__(Tabletop(workcell, furniture(basket), things, floors, areas, to_move, to_reach))

    @property
    def task(self) -> str:
        """The task in prose."""
        return task_text(self._instance, self.tabletop.workcell.model.description)

    @property
    def schemas(self) -> tuple[ActionSchema, ...]:
        """Pick and place."""
        return PICK, PLACE

    def describe(self, state: State) -> tuple[Entity, ...]:
        """The basket, the boxes and what is in the way, to the millimetre."""
        return describe(self._instance, self.tabletop.workcell.model.description, state)

    def prepare(self, state: State, action: Action, rng: np.random.Generator) -> MotionProblem | Failure:
        """A path to above the box or the place, from which the hand can come down and get away again."""
        (name,) = action.objects
        if action.name == PICK.name:
            return self.tabletop.pick(state, name, rng)
        return self.tabletop.place(state, name, **action.params, rng=rng)

    def goal(self, state: State) -> GoalStatus:
        """Every box in the basket with its whole footprint."""
        return goal_status(self._instance, state)
