"""The world: a disc that moves other things in the plane."""

from __future__ import annotations

import numpy as np

from llm3.errors import InstanceError
from llm3.interfaces import Env, Joint
from llm3.types import (
    Action,
    ActionSchema,
    Entity,
    EventKind,
    Failure,
    Goal,
    GoalStatus,
    Held,
    Motion,
    MotionProblem,
    NoMotion,
    Pose,
    State,
    Transition,
)
from llm3_tabletop2d.actions import MAX_ACCELERATION, MAX_VELOCITY, PICK, PLACE, schemas
from llm3_tabletop2d.bodies import Separation
from llm3_tabletop2d.goal import goal_status
from llm3_tabletop2d.instance import TabletopInstance
from llm3_tabletop2d.manipulation import Manipulation
from llm3_tabletop2d.scene import Scene, pose_at
from llm3_tabletop2d.start import start_fault
from llm3_tabletop2d.ways import CLEARANCE, RESOLUTION, is_free, touched
from llm3_tabletop2d.wording import describe, task_text


class TabletopEnv(Env):
    """Discs and boxes among walls, and a robot with two sliding joints: x and y of its centre."""

    def __init__(self, instance: TabletopInstance, radius: float) -> None:
        """Set up the world.

        Args:
            instance: The problem.
            radius: The robot's, in metres; 0 makes it a point.

        Raises:
            InstanceError: Things start in one another, or in the robot.
        """
        self._instance, self._radius = instance, radius
        self._scene = Scene(instance, radius)
        self._manipulation = Manipulation(self._scene, instance.room)
        fault = start_fault(self._scene, self.reset())
        if fault:
            raise InstanceError(fault)

    @property
    def task(self) -> str:
        """The task in prose."""
        return task_text(self._radius)

    @property
    def schemas(self) -> tuple[ActionSchema, ...]:
        """Pick, place and push."""
        return schemas(self._instance.room)

    @property
    def objects(self) -> tuple[str, ...]:
        """What can be moved."""
        return tuple(item.name for item in self._instance.objects)

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The two coordinates of the robot's centre."""
        return tuple(Joint(name, "m", MAX_VELOCITY, MAX_ACCELERATION) for name in ("x", "y"))

    def reset(self) -> State:
        """Everything at its start, and nothing held."""
        poses = {item.name: pose_at(*item.position, item.theta) for item in self._instance.objects}
        return State(poses, self._instance.robot)

    def describe(self, state: State) -> tuple[Entity, ...]:
        """The room and what is in it, to the millimetre."""
        return describe(self._instance, state)

    def prepare(
        self,
        state: State,
        action: Action,
        rng: np.random.Generator,  # noqa: ARG002  # there is one way to do each action
    ) -> MotionProblem | NoMotion | Failure:
        """A path to beside the object or the place, from which a straight piece does the rest."""
        (name,) = action.objects
        if action.name == PICK:
            answer: Goal | NoMotion | Failure = self._manipulation.pick(state, name, action.params["angle"])
        else:
            do = self._manipulation.place if action.name == PLACE else self._manipulation.push
            answer = do(state, name, np.array((action.params["x"], action.params["y"])))
        if isinstance(answer, (Failure, NoMotion)):
            return answer
        held = self._scene.body(state.held.object, state.held.grasp) if state.held else None
        separation = Separation(self._scene.moving(held), self._scene.standing(state))
        failure = self._manipulation.cut_off(state, name, separation, answer)
        if failure:
            return failure
        return MotionProblem(
            np.array(state.configuration),
            (answer,),
            self._manipulation.low,
            self._manipulation.high,
            valid=lambda Q: is_free(separation, Q),
            resolution=np.array((RESOLUTION, RESOLUTION)),
            explain=lambda q: touched(separation, q[None], CLEARANCE),
        )

    def apply(self, state: State, action: Action, motion: Motion) -> Transition:
        """The object in the robot's hold after a pick, and elsewhere after a place or a push."""
        if not motion.segments:
            return Transition(state)
        (name,) = action.objects
        others = {other: pose for other, pose in state.poses.items() if other != name}
        taken = next((event.grasp for event in motion.events if event.kind is EventKind.ATTACH), None)
        grasp = taken or (state.held.grasp if state.held else None)
        if grasp is None:
            raise ValueError(f"nobody holds {name}, so it cannot be moved")
        if action.name == PICK:
            return Transition(State(others, motion.end, Held(name, grasp)))
        x, y = motion.segments[-1].waypoints[0]
        pose = Pose((x + grasp.position[0], y + grasp.position[1], 0.0), grasp.orientation)
        return Transition(State({**others, name: pose}, motion.end))

    def goal(self, state: State) -> GoalStatus:
        """Every object that has a goal in its region."""
        return goal_status(self._instance, state)
