"""Carries out plans on a tabletop, by motors, friction and gravity."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from llm3.errors import InputError
from llm3.interfaces import Executor
from llm3.types import Executed, Execution, Failure, Motion, Noise, NoMotion, PlannedAction, Slip, State
from llm3_bullet.clients import connect
from llm3_bullet.execution import ExecutionSettings, MotorWorld, Performance, check_events, course, hand_of, scatter
from llm3_bullet.tabletop.env import TabletopEnv


class TabletopExecutor(Executor):
    """Plays plans of one problem, each in a world that is built for it."""

    def __init__(self, env: TabletopEnv, noise: Noise, settings: ExecutionSettings | None = None) -> None:
        """Take the problem.

        Args:
            env: The problem's world, which is asked what comes of actions without a motion. It is the executor's to
                close from now on.
            noise: By how much the world differs from plans.
            settings: The physics; None for the usual one.
        """
        self._env, self._noise, self._settings = env, noise, settings or ExecutionSettings()

    def execute(self, start: State, actions: tuple[PlannedAction, ...], rng: np.random.Generator) -> Execution:
        """Play a plan in a world of its own.

        Raises:
            InputError: The plan makes no sense for the robot or the boxes.
            UsageError: The noise leaves no room for a box.
        """
        model, sizes = self._env.tabletop.workcell.model, self._env.tabletop.sizes
        if start.held or set(start.poses) != set(sizes):
            raise InputError(f"the plan must start with an empty gripper, and with the poses of {', '.join(sizes)}.")
        check_events(model, sizes, actions)
        courses = course(model, actions, self._settings.boxes.time_step)
        offsets = rng.normal(0.0, self._noise.joints, model.dof)
        with connect() as client:
            boxes, standing = self._env.scene(start).boxes, np.array(start.configuration)
            world = MotorWorld(client, model, boxes, standing - offsets, self._settings)
            scatter(world, self._noise, rng)
            performance = Performance(world, hand_of(world), sizes, offsets)
            state = begun = performance.state(start.facts)
            done, before = [], start
            for step, of_action in zip(actions, courses, strict=True):
                if step.motion.segments:
                    executed = performance.perform(before, step, of_action)
                    state = performance.state(state.facts)
                else:
                    executed, state = self._do(state, step, rng)
                done.append(executed)
                before = step.state
        return Execution(begun, state, tuple(done))

    def close(self) -> None:
        """Stop the simulators."""
        self._env.close()

    def _do(self, state: State, step: PlannedAction, rng: np.random.Generator) -> tuple[Executed, State]:
        """An action without a motion, such as a chore: the problem's world knows what comes of it."""
        answer = self._env.prepare(state, step.action, rng)
        if isinstance(answer, NoMotion):
            facts = self._env.apply(state, step.action, Motion()).state.facts
            return Executed(step.action, 0.0), replace(state, facts=facts)
        reason = (answer.detail or answer.kind.value) if isinstance(answer, Failure) else "it needs a motion"
        return Executed(step.action, 0.0, slips=(Slip(f"it could not be done: {reason}"),)), state
