"""What is wrong with how a problem begins, as a sentence for who made it, or the robot."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from math import dist

import numpy as np

from llm3.errors import InputError, InstanceError
from llm3.types import ITSELF, Failure, Pose, State
from llm3_bullet.scene import Box, Scene
from llm3_bullet.tabletop.manipulation import Manipulation
from llm3_bullet.tabletop.overlaps import overlap
from llm3_bullet.tabletop.rectangles import Rectangle
from llm3_bullet.tabletop.resting import rests_on
from llm3_bullet.workcell import Workcell

SLAB = 0.01
"""Height in metres of what an area is taken for: at home, an arm is so low only where it stands."""


def check_start(
    workcell: Workcell,
    manipulation: Manipulation,
    start: State,
    areas: Mapping[str, Rectangle],
    to_move: Iterable[str],
    to_reach: Iterable[str],
) -> None:
    """See that a problem can begin, and does not ask for what this robot can certainly not do.

    Args:
        workcell: The robot.
        manipulation: The boxes, the furniture, and how the robot takes things.
        start: The first state, with the arm at home.
        areas: Where boxes have to be put down, by name.
        to_move: The names of boxes without a move of which the goal cannot be reached.
        to_reach: The names of areas without which it cannot.

    Raises:
        InstanceError: A box is called as a link of the robot is, or starts in another one, in the furniture, in the
            arm or in the air; the arm stands on an area; a box that has to be moved does not fit the gripper, or is
            farther away than the arm is long, as is an area without which the goal cannot be reached.
        InputError: The arm touches itself or the furniture.
    """
    _check_names(workcell, start)
    _check_boxes(manipulation.things(start.poses), start)
    _check_arm(workcell, manipulation.transit_scene(start), start)
    _check_areas(workcell, areas, start)
    for name in to_reach:
        _check_reach(workcell, name, areas[name])
    for name in to_move:
        _check_grasps(workcell, manipulation, start, name)


def _check_names(workcell: Workcell, start: State) -> None:
    """What touches what is told, and drawn, by names."""
    for name in start.poses:
        if name in workcell.model.links:
            robot = workcell.model.description.name
            raise InstanceError(f"{name} is what robot {robot!r} calls one of its links: give the box another name")


def _check_boxes(things: Sequence[Box], start: State) -> None:
    found = overlap(
        [thing for thing in things if thing.name in start.poses],
        [thing for thing in things if thing.name not in start.poses],
    )
    if found:
        raise InstanceError(f"{found[0]} and {found[1]} start in one another")
    for box in (thing for thing in things if thing.name in start.poses):
        if not any(rests_on(box.pose, box.size, below.pose, below.size) for below in things if below is not box):
            raise InstanceError(f"{box.name} rests on nothing where it starts, and would fall")


def _check_arm(workcell: Workcell, scene: Scene, start: State) -> None:
    contacts = workcell.checker.view(scene).contacts(np.array(start.configuration))
    among_boxes = dict.fromkeys(contact.object for contact in contacts if contact.object in start.poses)
    itself = dict.fromkeys(f"{c.link} and {c.other_link}" for c in contacts if c.object == ITSELF)
    fixed = dict.fromkeys(f"{c.link} and {c.object}" for c in contacts if c.object not in {*start.poses, ITSELF})
    if among_boxes:
        raise InstanceError(f"the arm touches {', '.join(among_boxes)} where it starts: move it farther from the arm.")
    if itself:
        raise InputError(
            f"links of the arm touch each other where it starts: {'; '.join(itself)}. Change the robot's home, or name "
            "pairs that always touch in its may_touch."
        )
    if fixed:
        raise InputError(
            f"the arm touches what stands around it where it starts: {'; '.join(fixed)}. Change the robot's home or "
            "base, or name links that it stands on in its mounted_links."
        )


def _check_areas(workcell: Workcell, areas: Mapping[str, Rectangle], start: State) -> None:
    slabs = Scene(tuple(_slab(name, area) for name, area in areas.items()))
    for contact in workcell.checker.view(slabs).contacts(np.array(start.configuration)) if areas else ():
        if contact.object in areas:
            raise InstanceError(f"the arm stands on {contact.object}: move it farther from the arm.")


def _check_reach(workcell: Workcell, name: str, area: Rectangle) -> None:
    disc = workcell.inverse.disc
    if dist(area.nearest(disc.center), disc.center) > disc.radius:
        raise InstanceError(f"{name} is out of the arm's reach: move it closer to the arm.")


def _slab(name: str, area: Rectangle) -> Box:
    half = np.arctan2(area.direction[1], area.direction[0]) / 2
    return Box(name, (*area.size, SLAB), Pose((*area.center, SLAB / 2), (0.0, 0.0, np.sin(half), np.cos(half))))


def _check_grasps(workcell: Workcell, manipulation: Manipulation, start: State, name: str) -> None:
    ways = manipulation.pick(start, name)
    if isinstance(ways, Failure):
        raise InstanceError(ways.detail)
    if workcell.inverse.too_far(np.array([way.tool for way in ways])).all():
        raise InstanceError(f"{name} starts out of the arm's reach: move it closer to the arm.")
