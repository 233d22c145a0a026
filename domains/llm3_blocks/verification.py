"""A second look at plans for towers: each action does what it says, and the blocks end where they belong."""

from __future__ import annotations

import numpy as np

from llm3.interfaces import PlanVerifier
from llm3.types import Action, PlannedAction, State, Verification
from llm3_blocks.actions import PICK, PLACE, STACK
from llm3_blocks.instance import BlocksInstance, On
from llm3_bullet.robot import RobotDescription
from llm3_bullet.tabletop.table import TABLE, table
from llm3_bullet.verification import Playback, check_let_go, check_pick, check_place, second_look

APART = 0.001
"""How far a block may end from what it belongs on, in metres."""
BESIDE = 0.001
"""How far the centre of a block may end from being over what it belongs on, in metres."""
DIRECTIONS = np.linspace(0.0, 2 * np.pi, 360, endpoint=False)


class BlocksVerifier(PlanVerifier):
    """Plays plans of one instance."""

    def __init__(self, instance: BlocksInstance, robot: RobotDescription) -> None:
        """Take the problem, and what solves it."""
        self._instance, self._robot = instance, robot

    def verify(self, start: State, actions: tuple[PlannedAction, ...]) -> Verification:
        """Play the plan in a world of its own."""
        sizes = {block.name: block.size for block in self._instance.blocks}
        return second_look(self._robot, (table(),), sizes, start, actions, _check_deed, self._check_goal)

    def _check_goal(self, playback: Playback) -> None:
        if playback.world.held:
            playback.findings.tell(f"{playback.world.held} ends in the gripper")
        for on in self._instance.goal:
            if playback.world.held not in (on.block, on.below):
                _check_on(playback, on)


def _check_on(playback: Playback, on: On) -> None:
    """See that a block touches what it belongs on, from above, and has its centre over it."""
    world, tell = playback.world, playback.findings.tell
    gap = world.neighbours(on.block).get(on.below)
    if gap is None or gap > APART:
        tell(f"{on.block} does not end on {on.below}: they do not touch")
    elif on.below != TABLE:
        center, height = np.array(world.frame(on.block)[0][:2]), world.frame(on.block)[0][2]
        corners = world.corners(on.below)
        ways = np.column_stack([np.cos(DIRECTIONS), np.sin(DIRECTIONS)])
        beside = float((center @ ways.T - (corners[:, :2] @ ways.T).max(axis=0)).max())
        if height < corners[:, 2].max():
            tell(f"{on.block} does not end on {on.below}: its centre is lower than the top of that one")
        elif beside > BESIDE:
            tell(f"{on.block} ends with its centre {beside * 1000:.1f} mm beside {on.below}", distance=beside)


def _check_deed(playback: Playback, action: Action) -> None:
    """See that the motion did what the action says; what is none of the domain's, the core tells."""
    names = action.objects
    if action.name == PICK.name and len(names) == 1:
        check_pick(playback, names[0])
    elif action.name == PLACE.name and len(names) == 1:
        if set(action.params) == {"x", "y", "theta"}:
            check_place(playback, names[0], **action.params)
        else:
            check_let_go(playback, names[0])
    elif action.name == STACK.name and len(names) == 2 and names[1] in playback.world.names:
        (x, y, _), _ = playback.world.frame(names[1])
        check_place(playback, names[0], x, y)
