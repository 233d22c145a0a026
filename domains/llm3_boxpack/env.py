"""The box-packing world."""

from __future__ import annotations

import numpy as np

from llm3.types import Action, ActionSchema, Entity, Failure, GoalStatus, MotionProblem, State
from llm3_boxpack.actions import PICK, PLACE
from llm3_boxpack.goal import goal_status
from llm3_boxpack.instance import BoxpackInstance
from llm3_boxpack.layout import furniture
from llm3_boxpack.wording import describe, task_text
from llm3_bullet.tabletop.env import TabletopEnv
from llm3_bullet.tabletop.table import support_height
from llm3_bullet.tabletop.tabletop import Tabletop
from llm3_bullet.workcell import Workcell


class BoxpackEnv(TabletopEnv):
    """Boxes, a basket and an arm."""

    def __init__(self, instance: BoxpackInstance, workcell: Workcell, wall_height: float = 0.0) -> None:
        """Set up the world.

        Args:
            instance: The problem.
            workcell: The robot and its simulators; the Env owns them from now on.
            wall_height: Height of the basket's walls in metres; 0 for none.

        Raises:
            InputError: It cannot begin, or not with this robot; see `Tabletop`.
        """
        self._instance, self._wall_height = instance, wall_height
        floors = (instance.basket.floor,)
        boxes = (box.standing(support_height(floors, box.footprint)) for box in instance.boxes)
        areas = {"basket": instance.basket.area}
        things = furniture(instance.basket, wall_height)
        super().__init__(Tabletop(workcell, things, boxes, floors, areas, instance.to_move))

    @property
    def task(self) -> str:
        """The task in prose."""
        return task_text(self.tabletop.workcell.gripper, self._wall_height)

    @property
    def schemas(self) -> tuple[ActionSchema, ...]:
        """Pick and place."""
        return PICK, PLACE

    def describe(self, state: State) -> tuple[Entity, ...]:
        """The basket and the boxes, to the millimetre."""
        return describe(self._instance, state)

    def prepare(self, state: State, action: Action, rng: np.random.Generator) -> MotionProblem | Failure:
        """A path to above the box or the place, from which the hand can come down and get away again."""
        (name,) = action.objects
        if action.name == PICK.name:
            return self.tabletop.pick(state, name, rng)
        return self.tabletop.place(state, name, **action.params, rng=rng)

    def goal(self, state: State) -> GoalStatus:
        """Every box in the basket with its whole footprint."""
        return goal_status(self._instance, state)
