"""The box-packing world."""

from __future__ import annotations

import numpy as np

from llm3.errors import InputError
from llm3.interfaces import Env, Joint
from llm3.types import (
    Action,
    ActionSchema,
    Entity,
    EventKind,
    Failure,
    GoalStatus,
    Held,
    Motion,
    MotionProblem,
    Pose,
    State,
    Transition,
)
from llm3_boxpack.actions import PICK, PLACE
from llm3_boxpack.goal import goal_status
from llm3_boxpack.instance import BoxpackInstance
from llm3_boxpack.layout import furniture, support_height
from llm3_boxpack.manipulation import Manipulation
from llm3_boxpack.release import surprises
from llm3_boxpack.start import start_fault
from llm3_boxpack.wording import describe, task_text
from llm3_bullet.poses import as_matrix, as_pose
from llm3_bullet.robot import RobotDescription
from llm3_bullet.scene import Scene
from llm3_bullet.workcell import Workcell

CLEARANCE = 0.005
"""Distance in metres that the arm keeps from everything on its way from one place to the next."""


class BoxpackEnv(Env):
    """Boxes, a basket and an arm, with a simulator as a cache of the state."""

    def __init__(self, instance: BoxpackInstance, workcell: Workcell, wall_height: float = 0.0) -> None:
        """Set up the world.

        Args:
            instance: The problem.
            workcell: The robot and its simulators; the Env owns them from now on.
            wall_height: Height of the basket's walls in metres; 0 for none.

        Raises:
            InputError: Something stands where the arm starts.
        """
        self._instance, self._cell, self._wall_height = instance, workcell, wall_height
        self._furniture = furniture(instance.basket, wall_height)
        boxes = {box.name: box for box in instance.boxes}
        self._manipulation = Manipulation(boxes, self._furniture, instance.basket, workcell.gripper)
        start = self.reset()
        contacts = workcell.checker.view(self.scene(start)).contacts(np.array(start.configuration))
        fault = start_fault(contacts, boxes)
        if fault:
            raise InputError(fault)

    def remade(self, instance: BoxpackInstance, robot: RobotDescription, wall_height: float) -> BoxpackEnv | None:
        """A world for another problem, which takes over the workcell; None for another robot.

        Args:
            instance: The other problem.
            robot: Its robot.
            wall_height: Height of the basket's walls in metres; 0 for none.

        Raises:
            InputError: Something stands where the arm starts; the workcell is still this world's then.
        """
        return BoxpackEnv(instance, self._cell, wall_height) if self._cell.fits(robot) else None

    @property
    def task(self) -> str:
        """The task in prose."""
        return task_text(self._cell.gripper, self._wall_height)

    @property
    def schemas(self) -> tuple[ActionSchema, ...]:
        """Pick and place."""
        return PICK, PLACE

    @property
    def objects(self) -> tuple[str, ...]:
        """The boxes."""
        return tuple(box.name for box in self._instance.boxes)

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The arm's joints."""
        model = self._cell.model
        return tuple(
            Joint(name, max_velocity=velocity, max_acceleration=acceleration)
            for name, velocity, acceleration in zip(
                model.description.arm_joints, model.max_velocity, model.max_acceleration, strict=True
            )
        )

    def reset(self) -> State:
        """The boxes at their start, the arm at home."""
        poses = {}
        for box in self._instance.boxes:
            height = support_height(self._instance.basket, box.footprint) + box.size[2] / 2
            poses[box.name] = Pose((*box.position, height), (0.0, 0.0, np.sin(box.yaw / 2), np.cos(box.yaw / 2)))
        return State(poses, tuple(self._cell.model.home))

    def describe(self, state: State) -> tuple[Entity, ...]:
        """The basket and the boxes, to the millimetre."""
        return describe(self._instance, state)

    def prepare(self, state: State, action: Action, rng: np.random.Generator) -> MotionProblem | Failure:
        """A path to above the box or the place, from which the hand can come down and get away again."""
        name = action.objects[0]
        if action.name == PICK.name:
            ways = self._manipulation.pick(state, name)
        else:
            ways = self._manipulation.place(state, name, **action.params)
        if isinstance(ways, Failure):
            return ways
        start = np.array(state.configuration)
        goals = self._cell.touchdowns.goals(ways, start, CLEARANCE, rng)
        if isinstance(goals, Failure):
            return goals
        scene = self.scene(state)
        transit = self._cell.checker.view(scene)
        return MotionProblem(
            start,
            goals,
            self._cell.model.low,
            self._cell.model.high,
            valid=lambda Q: transit.valid(Q, CLEARANCE),
            resolution=transit.resolution(CLEARANCE),
            uncertain=lambda start, end, steps: transit.uncertain(start, end, steps, CLEARANCE),
            explain=lambda q: transit.contacts(q, CLEARANCE),
            before=() if state.held else self._manipulation.open_to(scene.opening),
        )

    def apply(self, state: State, action: Action, motion: Motion) -> Transition:
        """The box in the hand after a pick, and let go after a place; the others as physics leaves them."""
        if action.name == PICK.name:
            (attach,) = (event for event in motion.events if event.kind is EventKind.ATTACH)
            if attach.object is None or attach.grasp is None:
                raise ValueError("an attach event names its object and its grasp")
            standing = (*self._furniture, *self._manipulation.movable(state.poses))
            poses = self._cell.settler.settle_without(attach.object, standing)
            after = State(poses, motion.end, Held(attach.object, attach.grasp))
            return Transition(after, surprises(state.poses, after.poses))
        if state.held is None:
            raise ValueError("nothing is held, so nothing can be placed")
        bottom = self._cell.kinematics.tool(np.array([motion.segments[-1].waypoints[0]]))[0]
        released = {**state.poses, state.held.object: as_pose(bottom @ as_matrix(state.held.grasp))}
        everything = (*self._furniture, *self._manipulation.movable(released))
        settled = self._cell.settler.settle_around(state.held.object, everything)
        after = State(settled, motion.end)
        return Transition(after, surprises(released, after.poses))

    def scene(self, state: State) -> Scene:
        """Everything that surrounds the robot in a state."""
        return self._manipulation.transit_scene(state)

    def goal(self, state: State) -> GoalStatus:
        """Every box in the basket with its whole footprint."""
        return goal_status(self._instance, state)

    def close(self) -> None:
        """Stop the simulators."""
        self._cell.close()
