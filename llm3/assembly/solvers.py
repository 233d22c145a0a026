"""The two ways to solve a problem, each with what it needs besides the world."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass, field

from llm3.budget import Budget
from llm3.interfaces import Env, FeedbackSynthesizer, LLMBackend, MotionPlanner, Regions, TrajectoryTimer
from llm3.prompts import Prompt
from llm3.search import search
from llm3.solve import solve
from llm3.types import FrozenDict, Observer, Result, Sketch


class Solver(ABC):
    """Finds a plan for the problem of any world."""

    @property
    @abstractmethod
    def language_model(self) -> bool:
        """Whether a language model is asked."""

    @property
    @abstractmethod
    def notice(self) -> str:
        """One line that the user should read before the run, or nothing."""

    @property
    def last_words(self) -> str:
        """One line that the user should read after the run, or nothing."""
        return ""

    @abstractmethod
    def solve(
        self,
        env: Env,
        *,
        planner: MotionPlanner,
        timer: TrajectoryTimer | None,
        budget: Budget,
        seed: int,
        observer: Observer,
    ) -> Result:
        """Run it; see :func:`llm3.solve` and :func:`llm3.search`."""

    def close(self) -> None:
        """Let go of connections. Calling it twice does no harm."""


@dataclass(frozen=True)
class Loop(Solver):
    """The paper's loop: :func:`llm3.solve`."""

    backend: LLMBackend
    prompt: Prompt
    feedback: FeedbackSynthesizer
    skeleton: tuple[Sketch, ...] = ()
    """The given action sequence, where the strategy fixes it."""

    @property
    def language_model(self) -> bool:
        """Whether the backend is one."""
        return self.backend.is_language_model

    @property
    def notice(self) -> str:
        """What the backend has to say about itself."""
        return self.backend.notice

    @property
    def last_words(self) -> str:
        """What the backend has to say after the run."""
        return self.backend.last_words

    def solve(
        self,
        env: Env,
        *,
        planner: MotionPlanner,
        timer: TrajectoryTimer | None,
        budget: Budget,
        seed: int,
        observer: Observer,
    ) -> Result:
        """Ask the model for plans until one works."""
        return solve(
            env,
            backend=self.backend,
            planner=planner,
            feedback=self.feedback,
            prompt=self.prompt,
            timer=timer,
            skeleton=self.skeleton,
            budget=budget,
            seed=seed,
            observer=observer,
        )

    def close(self) -> None:
        """Let go of the backend."""
        self.backend.close()


@dataclass(frozen=True)
class Search(Solver):
    """A search without a model: :func:`llm3.search`."""

    regions: Regions = field(default_factory=FrozenDict)

    @property
    def language_model(self) -> bool:
        """None is asked."""
        return False

    @property
    def notice(self) -> str:
        """Says so."""
        return "No language model is used: a search tries actions with parameters drawn at random."

    def solve(
        self,
        env: Env,
        *,
        planner: MotionPlanner,
        timer: TrajectoryTimer | None,
        budget: Budget,
        seed: int,
        observer: Observer,
    ) -> Result:
        """Search for a plan."""
        return search(
            env, planner=planner, regions=self.regions, timer=timer, budget=budget, seed=seed, observer=observer
        )
