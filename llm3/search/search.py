"""The search itself: probe after probe, each depth first."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from time import perf_counter

import numpy as np

from llm3.budget import Budget
from llm3.errors import UsageError
from llm3.guarded import guarded
from llm3.interfaces import Env, MotionPlanner, Regions, TrajectoryTimer
from llm3.rollout import Roller
from llm3.search.limits import Limits
from llm3.search.moves import Move, moves_of
from llm3.seeding import generator
from llm3.solve import ended, teller
from llm3.types import (
    Action,
    Attempt,
    AttemptEnded,
    FailureKind,
    FrozenDict,
    GoalStatus,
    Observer,
    PlannedAction,
    Proposal,
    ReplyRead,
    Result,
    RunStarted,
    Sketch,
    State,
    Stats,
    Stop,
    nobody,
)

MOTION_CALLS = 2000
"""The limit of a search that is given none."""
ATTEMPTS = 20
"""How many plans are tried at most for each motion call that may be made: where nothing moves, none is ever made."""


def search(
    env: Env,
    *,
    planner: MotionPlanner,
    regions: Regions = FrozenDict(),
    timer: TrajectoryTimer | None = None,
    budget: Budget = Budget(max_motion_calls=MOTION_CALLS),
    seed: int = 0,
    observer: Observer = nobody,
    clock: Callable[[], float] = perf_counter,
) -> Result:
    """Search for a plan, depth first, until one reaches the goal or the budget ends.

    Nothing is known of the domain but its action schemas and how many parts of the goal are unmet. An action is tried
    by a rollout of the whole plan that ends with it, of which the beginning is remembered: each attempt evaluates one
    action at most. As in enforced hill climbing, a plan is carried on where it makes progress, or after a few actions
    without any. Every probe begins anew, with other samples: most are narrow, and at intervals, by the universal
    restart sequence, some are wider, longer, and patient with detours. So every solution that has room around its
    parameters is found in the end, if the budget allows.

    - J. Hoffmann and B. Nebel, "The FF planning system", Journal of Artificial Intelligence Research 14, 2001.
    - M. Luby, A. Sinclair and D. Zuckerman, "Optimal speedup of Las Vegas algorithms", Information Processing Letters
      47(4), 1993.
    - C. R. Garrett et al., "Integrated task and motion planning", Annual Review of Control, Robotics, and Autonomous
      Systems 4, 2021, for searching and sampling in turn.

    Args:
        env: The problem.
        planner: Finds the paths.
        regions: Tighter ranges for the parameters than the schemas', where the domain has them.
        timer: Puts times to the motions of the plan that is found, if the world knows the limits of all joints.
        budget: What the run may spend: motion calls, seconds, or both. It makes no model calls.
        seed: All randomness derives from it: the same seed gives the same run.
        observer: Is told of everything as it happens.
        clock: Seconds, for the times by phase.

    Returns:
        The plan, if one was found, every attempt, and what was spent.

    Raises:
        LLM3Error: The program cannot go on, or the budget has no limit that a search can reach.
    """
    if budget.max_motion_calls is None and budget.max_seconds is None:
        raise UsageError("a search needs a limit: max_motion_calls, max_seconds, or both.")
    return _Search(env, planner, regions, budget, seed, observer, clock).run(timer)


@dataclass
class _Node:
    """A plan that is feasible, and where it leads."""

    plan: tuple[Action, ...]
    state: State
    unmet: tuple[str, ...]
    least: int
    """The fewest unmet parts of the goal on the way."""
    stalled: int = 0
    """How many actions ago that was."""
    moves: Iterator[Move] = field(default_factory=lambda: iter(()))
    """What is still to be tried here, a move for each sample."""
    impossible: set[Sketch] = field(default_factory=set)
    """What failed for a precondition here."""


class _Search:
    """One run."""

    def __init__(
        self,
        env: Env,
        planner: MotionPlanner,
        regions: Regions,
        budget: Budget,
        seed: int,
        observer: Observer,
        clock: Callable[[], float],
    ) -> None:
        self._env, self._budget, self._seed, self._observer, self._clock = env, budget, seed, observer, clock
        self._began = clock()
        self._start = guarded(env.reset, (State,))
        self._roller = Roller(env, planner, seed, clock)
        self._moves = tuple(moves_of(env, regions))
        self._setbacks: set[tuple[tuple[str, ...], Sketch]] = set()
        self._attempts: list[Attempt] = []
        self._plan: tuple[PlannedAction, ...] = ()
        self._stop: Stop | None = None
        self._left_out = False
        """Whether anything was left out of the probe, on purpose or by chance."""

    def run(self, timer: TrajectoryTimer | None) -> Result:
        """Probe until it stops."""
        self._observer(RunStarted(self._start))
        state, attempt = self._tried(())
        probe = 0
        while not self._stop:
            probe += 1
            self._left_out = False
            self._probe(_Node((), state, attempt.goal.unmet, len(attempt.goal.unmet)), probe)
            if not self._stop and not self._left_out:
                self._stop = "exhausted"
        solved = self._stop == "solved"
        plan = self._plan if solved else ()
        last = self._attempts[-1]
        attempts = tuple(self._attempts)
        result = Result(solved, plan, last.goal, attempts, self._roller.stats, self._start, self._stop)
        return ended(result, self._env, timer, self._observer, self._clock)

    def _probe(self, root: _Node, number: int) -> None:
        """Search depth first from the initial state, within limits that go by the number of the probe."""
        limits, rng = Limits.of(number), generator("search", self._seed, number)
        most = self._roller.stats.motion_calls + limits.share
        root.moves = self._ways(root, limits, rng)
        seen, path = {root.state}, [root]
        while path and not self._stop:
            node = path[-1]
            move = next(node.moves, None)
            if move is None:
                path.pop()
                continue
            if self._roller.stats.motion_calls >= most:
                self._left_out = True
                return
            child = self._child(node, move, limits, rng)
            if child and child.state not in seen:
                seen.add(child.state)
                child.moves = self._ways(child, limits, rng)
                path.append(child)

    def _ways(self, node: _Node, limits: Limits, rng: np.random.Generator) -> Iterator[Move]:
        """What to try at a node, in random order."""
        for index in rng.permutation(len(self._moves)):
            move = self._moves[index]
            self._left_out |= bool(move.ranges)
            for _ in range(limits.width if move.ranges else 1):
                if not limits.setback and (node.unmet, move.sketch) in self._setbacks:
                    self._left_out = True
                elif move.sketch not in node.impossible:
                    yield move

    def _child(self, node: _Node, move: Move, limits: Limits, rng: np.random.Generator) -> _Node | None:
        """Where a move leads, if it is feasible and worth going on from."""
        plan = (*node.plan, move.drawn(rng))
        state, attempt = self._tried(plan)
        failure = attempt.failure
        if failure:
            self._left_out |= not failure.kind.is_final
            if failure.kind is FailureKind.PRECONDITION:
                node.impossible.add(move.sketch)
            return None
        unmet = attempt.goal.unmet
        stalled = 0 if len(unmet) < node.least else node.stalled + 1
        if len(unmet) > node.least and not move.ranges:
            self._setbacks.add((node.unmet, move.sketch))
        if len(unmet) > node.least + limits.setback or stalled > limits.plateau:
            self._left_out = True
            return None
        return _Node(plan, state, unmet, min(node.least, len(unmet)), stalled)

    def _tried(self, plan: tuple[Action, ...]) -> tuple[State, Attempt]:
        """Roll a plan out as the next attempt, and see whether that ends the run."""
        number, proposal = len(self._attempts) + 1, Proposal(plan)
        self._observer(ReplyRead(number, proposal))
        rolled = self._roller.rollout(self._start, plan, teller(self._observer, number))
        goal = guarded(self._env.goal, (GoalStatus,), rolled.state)
        attempt = Attempt(number, goal, proposal, outcomes=rolled.outcomes)
        self._attempts.append(attempt)
        self._plan = rolled.plan
        stats = self._roller.stats
        self._observer(AttemptEnded(attempt, None, stats))
        self._stop = "solved" if goal.achieved else self._used_up(stats)
        return rolled.state, attempt

    def _used_up(self, stats: Stats) -> Stop | None:
        stop = self._budget.used_up(stats, self._clock() - self._began)
        most = self._budget.max_motion_calls
        if not stop and most is not None and len(self._attempts) >= ATTEMPTS * most:
            return "attempts"
        return stop
