"""A second look at a whole plan, in which a domain says what its actions do and what its goal is."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

import numpy as np

from llm3.types import Action, Defect, PlannedAction, State, Verification
from llm3_bullet.clients import connect
from llm3_bullet.robot import RobotDescription
from llm3_bullet.scene import Box, Size
from llm3_bullet.verification.playback import Playback
from llm3_bullet.verification.world import PlainWorld


def second_look(
    robot: RobotDescription,
    fixed: Iterable[Box],
    sizes: Mapping[str, Size],
    start: State,
    actions: Iterable[PlannedAction],
    check_deed: Callable[[Playback, Action], None],
    check_goal: Callable[[Playback], None],
) -> Verification:
    """Play a plan in a world of its own.

    Args:
        robot: What carries it out.
        fixed: Boxes that nothing moves.
        sizes: Of the boxes that the robot may take, by name.
        start: Where the plan says that it begins.
        actions: The plan.
        check_deed: Is called after each action, and tells in what its motion did not do what the action says.
        check_goal: Is called at the end, and tells what of the goal is missing.

    Raises:
        MissingDependency: PyBullet is not installed.
    """
    if start.held or set(start.poses) != set(sizes):
        sentence = f"the plan must start with an empty gripper, and with the poses of {', '.join(sizes)}"
        return Verification((Defect(sentence),))
    boxes = (Box(name, size, start.poses[name]) for name, size in sizes.items())
    with connect() as client, np.errstate(over="ignore", invalid="ignore"):  # a broken plan may hold any number
        playback = Playback(PlainWorld(client, robot, fixed, boxes), start)
        for step in actions:
            playback.play(step)
            check_deed(playback, step.action)
        playback.findings.end_actions()
        check_goal(playback)
        return playback.findings.report()
