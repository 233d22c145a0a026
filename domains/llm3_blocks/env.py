"""The world of towers."""

from __future__ import annotations

import numpy as np

from llm3.errors import InstanceError
from llm3.types import Action, ActionSchema, Entity, Failure, GoalStatus, MotionProblem, State
from llm3_blocks.actions import PICK, PLACE, STACK
from llm3_blocks.goal import goal_status
from llm3_blocks.instance import BlocksInstance
from llm3_blocks.wording import describe, task_text
from llm3_bullet.tabletop.env import TabletopEnv
from llm3_bullet.tabletop.table import table
from llm3_bullet.tabletop.tabletop import Tabletop
from llm3_bullet.workcell import Workcell


class BlocksEnv(TabletopEnv):
    """Blocks, a table and an arm."""

    def __init__(self, instance: BlocksInstance, workcell: Workcell) -> None:
        """Set up the world.

        Args:
            instance: The problem.
            workcell: The robot and its simulators; the Env owns them from now on.

        Raises:
            InputError: It cannot begin, or not with this robot; see `Tabletop`. Or a tower of the goal is too high.
        """
        self._instance = instance
        _check_heights(instance, workcell.inverse.highest)
        blocks = {box.name: box for tower in instance.towers for box in tower.standing(instance.sizes)}
        boxes = (blocks[block.name] for block in instance.blocks)
        super().__init__(Tabletop(workcell, (table(),), boxes, to_move=instance.to_move))

    @property
    def task(self) -> str:
        """The task in prose."""
        return task_text(self._instance, self.tabletop.workcell.gripper)

    @property
    def schemas(self) -> tuple[ActionSchema, ...]:
        """Pick, place and stack."""
        return PICK, PLACE, STACK

    def describe(self, state: State) -> tuple[Entity, ...]:
        """The blocks to the millimetre, each with what it stands on."""
        return describe(self._instance, state)

    def prepare(self, state: State, action: Action, rng: np.random.Generator) -> MotionProblem | Failure:
        """A path to above the block or the place, from which the hand can come down and get away again."""
        block, *others = action.objects
        if action.name == PLACE.name:
            return self.tabletop.place(state, block, **action.params, rng=rng)
        if action.name == STACK.name:
            return self.tabletop.stack(state, block, others[0], rng)
        covered = self.tabletop.covered(state, block, f"{block} cannot be picked")
        return covered or self.tabletop.pick(state, block, rng)

    def goal(self, state: State) -> GoalStatus:
        """Every block of the goal rests where it belongs."""
        return goal_status(self._instance, state)


def _check_heights(instance: BlocksInstance, highest: float) -> None:
    heights = instance.heights
    for name in instance.to_move:
        height = heights.get(name, 0.0)
        if height > highest:
            raise InstanceError(
                f"the goal has {name} {height:.2f} m above the table, and the arm puts nothing down higher than "
                f"{highest:.2f} m"
            )
