"""A table with boxes that an arm takes from above, and puts down again: what a domain builds its Env on."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np

from llm3.interfaces import Joint
from llm3.types import EventKind, Failure, FrozenDict, Held, Motion, MotionProblem, State, Transition
from llm3_bullet.poses import as_matrix, as_pose
from llm3_bullet.scene import Box, Scene
from llm3_bullet.tabletop.manipulation import Manipulation, precondition
from llm3_bullet.tabletop.rectangles import Rectangle
from llm3_bullet.tabletop.resting import boxes_on
from llm3_bullet.tabletop.stance import stance
from llm3_bullet.tabletop.start_check import check_start
from llm3_bullet.tabletop.surprises import is_still, surprises
from llm3_bullet.tabletop.table import Surface, support_height
from llm3_bullet.touchdown import Touchdown
from llm3_bullet.workcell import Workcell

CLEARANCE = 0.005
"""Distance in metres that the arm keeps from everything on its way from one place to the next."""
QUARTERS = (0.0, np.pi, np.pi / 2, -np.pi / 2)
"""How a stacked box may be turned against the one below, in radians."""


class Tabletop:
    """Answers what motion a pick, a place or a stack needs, and what comes of it; states go in and out."""

    def __init__(
        self,
        workcell: Workcell,
        furniture: Iterable[Box],
        boxes: Iterable[Box],
        surfaces: Iterable[Surface] = (),
        areas: Mapping[str, Rectangle] = FrozenDict(),
        to_move: Iterable[str] = (),
        to_reach: Iterable[str] = (),
    ) -> None:
        """Set it up, unless something is wrong with how it begins.

        Args:
            workcell: The robot and its simulators.
            furniture: What nothing moves; the table is not among it by itself.
            boxes: What the arm can take, where it starts.
            surfaces: Where boxes are put down higher than on the table.
            areas: Where boxes have to be put down, by name.
            to_move: The names of boxes without a move of which the goal cannot be reached.
            to_reach: The names of areas without which it cannot.

        Raises:
            InstanceError: A box starts in another one, in the furniture, in the arm or in the air; the arm stands on
                an area; a box that has to be moved does not fit the gripper, or is farther away than the arm is long,
                as is an area without which the goal cannot be reached.
            InputError: The arm touches itself or the furniture where it starts.
        """
        self.workcell, self._furniture, self._surfaces = workcell, tuple(furniture), tuple(surfaces)
        start = {box.name: box for box in boxes}
        self.sizes = {name: box.size for name, box in start.items()}
        """Of all boxes, along their own axes, by name."""
        self.start = State({name: box.pose for name, box in start.items()}, tuple(workcell.model.home))
        """The boxes at their start, the arm at home."""
        self._manipulation = Manipulation(self.sizes, self._furniture, workcell.gripper)
        check_start(workcell, self._manipulation, self.start, areas, to_move, to_reach)

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The arm's joints."""
        model = self.workcell.model
        return tuple(
            Joint(name, "rad", velocity, acceleration, float(low), float(high))
            for name, velocity, acceleration, low, high in zip(
                model.description.arm_joints,
                model.max_velocity,
                model.max_acceleration,
                model.low,
                model.high,
                strict=True,
            )
        )

    def scene(self, state: State) -> Scene:
        """Everything that surrounds the robot in a state."""
        return self._manipulation.transit_scene(state)

    # ---- what an action needs -------------------------------------------------------------------------

    def pick(self, state: State, name: str, rng: np.random.Generator) -> MotionProblem | Failure:
        """Take a box from above: a path to above it, from which the hand can come down and get away again."""
        ways = self._manipulation.pick(state, name)
        return ways if isinstance(ways, Failure) else self._query(state, ways, rng)

    def place(
        self, state: State, name: str, x: float, y: float, theta: float, rng: np.random.Generator
    ) -> MotionProblem | Failure:
        """Put the held box down on the table, or on a surface that its footprint touches, with its centre at (x, y)."""
        box = self._manipulation.in_hand(state, name)
        if isinstance(box, Failure):
            return box
        below = support_height(self._surfaces, box.standing.footprint((x, y), theta))
        return self._query(state, (self._manipulation.place(state, box, (x, y), theta, below),), rng)

    def stack(self, state: State, name: str, below: str, rng: np.random.Generator) -> MotionProblem | Failure:
        """Put the held box down on the middle of another one, with its sides along those of that one."""
        box = self._manipulation.in_hand(state, name, "stack")
        if isinstance(box, Failure):
            return box
        if name == below:
            return precondition(f"{name} cannot be stacked on itself.", name)
        covered = self.covered(state, below, "nothing else can be stacked on it")
        if covered:
            return covered
        pose = as_matrix(state.poses[below])
        support = stance(pose[:3, :3], self.sizes[below])
        if support is None:
            return precondition(f"{below} leans, so nothing can be stacked on it.", below)
        center, top = (pose[0, 3], pose[1, 3]), pose[2, 3] + support.extent[2] / 2
        thetas = (support.yaw + turn for turn in QUARTERS)
        return self._query(state, (self._manipulation.place(state, box, center, theta, top) for theta in thetas), rng)

    def covered(self, state: State, name: str, consequence: str) -> Failure | None:
        """The precondition that nothing stands on a box; None if it is met.

        Args:
            state: Where the action begins.
            name: The box's.
            consequence: What cannot be done, such as ``"red_box cannot be picked"``.
        """
        above = boxes_on(name, state.poses, self.sizes) if name in state.poses else ()  # in the hand, none is
        if not above:
            return None
        stand = "stands" if len(above) == 1 else "stand"
        return precondition(f"{' and '.join(above)} {stand} on {name}, so {consequence}.", *above)

    def _query(self, state: State, ways: Iterable[Touchdown], rng: np.random.Generator) -> MotionProblem | Failure:
        """The paths to where one of the touchdowns can begin."""
        cell, start = self.workcell, np.array(state.configuration)
        goals = cell.touchdowns.goals(ways, start, CLEARANCE, rng)
        if isinstance(goals, Failure):
            return goals
        scene = self.scene(state)
        transit = cell.checker.view(scene)
        return MotionProblem(
            start,
            goals,
            cell.model.low,
            cell.model.high,
            valid=lambda Q: transit.valid(Q, CLEARANCE),
            resolution=transit.resolution(CLEARANCE),
            uncertain=lambda start, end, steps: transit.uncertain(start, end, steps, CLEARANCE),
            explain=lambda q: transit.contacts(q, CLEARANCE),
            before=() if state.held else self._manipulation.open_to(scene.opening),
        )

    # ---- what comes of it -----------------------------------------------------------------------------

    def after(self, state: State, motion: Motion) -> Transition:
        """The box in the hand if the motion takes one, and let go if it lets one go; the others as physics leaves them.

        Raises:
            ValueError: The motion does neither, or does not fit the state.
        """
        for event in motion.events:
            if event.kind is EventKind.ATTACH and event.object is not None and event.grasp is not None:
                return self._taken(state, motion, Held(event.object, event.grasp))
            if event.kind is EventKind.DETACH:
                return self._let_go(state, motion)
        raise ValueError("the motion takes nothing and lets nothing go")

    def _taken(self, state: State, motion: Motion, held: Held) -> Transition:
        standing = self._manipulation.things(state.poses)
        settled = self.workcell.settler.settle_without(held.object, standing)
        before = state.poses
        poses = {n: before[n] if is_still(before[n], pose, self.sizes[n]) else pose for n, pose in settled.items()}
        after = replace(state, poses=poses, configuration=motion.end, held=held)
        return Transition(after, surprises(state.poses, after.poses))

    def _let_go(self, state: State, motion: Motion) -> Transition:
        if state.held is None:
            raise ValueError("nothing is held, so nothing can be placed")
        name = state.held.object
        bottom = self.workcell.kinematics.tool(np.array([motion.segments[-1].waypoints[0]]))[0]
        released = {**state.poses, name: as_pose(bottom @ as_matrix(state.held.grasp))}
        poses = self.workcell.settler.settle_around(name, self._manipulation.things(released))
        after = replace(state, poses=poses, configuration=motion.end, held=None)
        return Transition(after, surprises(released, after.poses))
