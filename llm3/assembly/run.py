"""A run that is ready to start."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import TracebackType

from threadpoolctl import threadpool_limits

from llm3.assembly.config import RunConfig
from llm3.assembly.problem import Problem
from llm3.assembly.solvers import Solver
from llm3.interfaces import Env, MotionPlanner, TrajectoryTimer
from llm3.types import FrozenDict, Observer, Result, nobody


@dataclass(frozen=True)
class Run:
    """A world and all that solves its problem, made from a RunConfig. Close it, or use it in a ``with``."""

    config: RunConfig
    problem: Problem
    solver: Solver
    planner: MotionPlanner
    timer: TrajectoryTimer | None = None
    plugins: Mapping[str, str] = field(default_factory=FrozenDict)
    """Where the plugins that it uses come from, by kind and name: see `Prepared.plugins`."""

    def solve(self, observer: Observer = nobody) -> Result:
        """Run it; see :func:`llm3.solve` and :func:`llm3.search`.

        numpy's linear algebra works on one thread meanwhile: the matrices here are small, so that more threads make it
        several times slower, and the last bits of a sum would depend on their number.
        """
        with threadpool_limits(1, user_api="blas"):
            return self.solver.solve(
                self.problem.env,
                planner=self.planner,
                timer=self.timer,
                budget=self.config.budget,
                seed=self.config.seed,
                observer=observer,
            )

    def release(self) -> Env:
        """Close all but the world, and give that away, for `Prepared.open` to make another one of."""
        env = self.problem.release()
        self.close()
        return env

    def close(self) -> None:
        """Let go of the solver, and of the world unless it was given away. Calling it twice does no harm."""
        try:
            self.solver.close()
        finally:
            self.problem.close()

    def __enter__(self) -> Run:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()
