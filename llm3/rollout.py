"""The inner half of the loop: try a plan, action by action, from the initial state."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field

from llm3.guarded import guarded
from llm3.interfaces import Env, MotionPlanner
from llm3.seeding import generator
from llm3.types import (
    Action,
    Failure,
    Motion,
    MotionProblem,
    NoMotion,
    Outcome,
    Path,
    PlannedAction,
    Rejected,
    State,
    Stats,
    Transition,
)


@dataclass(frozen=True)
class Verdict:
    """What is known of an action in a state: how it is done and where it leads, or why it fails."""

    step: PlannedAction | None = None
    notes: tuple[str, ...] = ()
    failure: Failure | None = None


@dataclass
class Memory:
    """Verdicts of earlier attempts by state and action.

    An action that was found feasible, or infeasible for a reason that no other seed would change, is not evaluated
    again. "No path within budget" is: with the number of earlier tries in its seed.
    """

    verdicts: dict[tuple[State, Action], Verdict] = field(default_factory=dict)
    tries: dict[tuple[State, Action], int] = field(default_factory=dict)


@dataclass(frozen=True)
class Rollout:
    """How far a plan went."""

    outcomes: tuple[Outcome, ...]
    plan: tuple[PlannedAction, ...]
    """The actions that are feasible, in order."""
    state: State
    """Where the last feasible action led."""


Tell = Callable[[int, State, Outcome, PlannedAction | None], None]
"""Is told of an action's place in the plan, the state before it, its outcome and, if it is feasible, how it is done."""


class Roller:
    """Rolls out plans in one world, and remembers and counts what it did."""

    def __init__(self, env: Env, planner: MotionPlanner, seed: int, clock: Callable[[], float]) -> None:
        """Bind a world and a planner.

        Args:
            env: The world.
            planner: Finds the paths.
            seed: The run's seed; every query's randomness derives from it, the state, the action and the try.
            clock: Seconds, for the times by phase.
        """
        self._env, self._planner, self._seed, self._clock = env, planner, seed, clock
        self._memory = Memory()
        self.stats = Stats()

    def rollout(
        self,
        start: State,
        actions: Sequence[Action | Rejected],
        observe: Tell = lambda _index, _before, _outcome, _step: None,
    ) -> Rollout:
        """Try the actions one after another until one fails.

        Args:
            start: Where the first action begins.
            actions: A whole plan; a `Rejected` item fails when it is reached.
            observe: Called for each action as it happens.
        """
        state = start
        outcomes: list[Outcome] = []
        plan: list[PlannedAction] = []
        for index, action in enumerate(actions):
            outcome, step = self._try(state, action)
            outcomes.append(outcome)
            observe(index, state, outcome, step)
            if step is None:
                break
            plan.append(step)
            state = step.state
        return Rollout(tuple(outcomes), tuple(plan), state)

    def _try(self, state: State, action: Action | Rejected) -> tuple[Outcome, PlannedAction | None]:
        if isinstance(action, Rejected):
            return Outcome(action, action.failure), None
        key = (state, action)
        verdict = self._memory.verdicts.get(key)
        reused = verdict is not None
        if verdict is None:
            verdict = self._evaluate(state, action, self._memory.tries.get(key, 0))
            if verdict.failure is None or verdict.failure.kind.is_final:
                self._memory.verdicts[key] = verdict
            else:
                self._memory.tries[key] = self._memory.tries.get(key, 0) + 1
        else:
            self.stats += Stats(reused_actions=1)
        moved = verdict.step is None or bool(verdict.step.motion.segments)
        return Outcome(action, verdict.failure, verdict.notes, reused, moved), verdict.step

    def _evaluate(self, state: State, action: Action, tries: int) -> Verdict:
        with self._phase("prepare"):
            rng = generator("prepare", self._seed, state, action, tries)
            answer = guarded(self._env.prepare, (MotionProblem, NoMotion, Failure), state, action, rng)
        if isinstance(answer, MotionProblem) or (isinstance(answer, Failure) and answer.kind.is_motion):
            self.stats += Stats(motion_calls=1)
        if isinstance(answer, MotionProblem):
            with self._phase("plan"):
                rng = generator("plan", self._seed, state, action, tries)
                path = guarded(self._planner.plan, (Path, Failure), answer, rng)
            self.stats += answer.cost + path.stats
            if isinstance(path, Failure):
                return Verdict(failure=path)
            motion = answer.motion(path)
        else:
            self.stats += answer.stats
            if isinstance(answer, Failure):
                return Verdict(failure=answer)
            motion = Motion()
        with self._phase("apply"):
            transition = guarded(self._env.apply, (Transition,), state, action, motion)
        return Verdict(PlannedAction(action, motion, transition.state), transition.notes)

    @contextmanager
    def _phase(self, name: str) -> Iterator[None]:
        began = self._clock()
        yield
        self.stats += Stats(seconds={name: self._clock() - began})
