"""One problem of a domain, in two worlds that were made alike."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from llm3.interfaces import Domain, Env, Options, Regions
from llm3.seeding import generator
from llm3.testing.conformance.helpers import Helpers
from llm3.testing.conformance.look import Look
from llm3.testing.conformance.regions import usable_regions
from llm3.testing.conformance.samples import malformed
from llm3.types import (
    Action,
    Failure,
    Motion,
    MotionProblem,
    NoMotion,
    Path,
    Result,
    Sketch,
    State,
    Transition,
)

T = TypeVar("T")
SLOW, FEW = 0.1, 6
"""How long `prepare` takes in a world of which less is asked, in seconds, and what is asked of it."""
QUERIES = 4
"""How many motion problems of each kind of action are looked at."""


@dataclass(frozen=True, eq=False)
class Trial:
    """What became of one action in one state."""

    state: State
    action: Action
    answer: MotionProblem | NoMotion | Failure
    """What `prepare` answered."""
    malformed: bool = False
    """Whether it is a motion problem whose validity test does not answer as it should, so that none can plan it."""
    failure: Failure | None = None
    """Why it cannot be done, by the Env or by the planner; None if it can, or if there was no planner."""
    motion: Motion | None = None
    transition: Transition | None = None
    """Where it led; None if it was not carried out."""

    def __str__(self) -> str:
        return str(self.action)


Query = tuple[Trial, MotionProblem]


@dataclass(eq=False)
class World:
    """A problem, two worlds of it, and what was tried there."""

    domain: Domain
    setting: str
    seed: int
    instance: Any
    options: Options
    env: Env
    twin: Env | None
    """Another world of the same instance; only some have one, as it may be dear."""
    spare: Env | None
    """A world of another instance that is no longer needed."""
    another: Callable[[], Env]
    """Makes one more world of the instance; whoever made this one closes it."""
    helpers: Helpers
    clock: Callable[[], float]
    """Seconds."""
    where: str
    """What sentences about it begin with, such as ``"easy, seed 1"``."""
    start: State = field(init=False)
    trials: list[Trial] = field(default_factory=list)
    result: Result | None = None
    """A solution, where one was found."""
    led: bool | None = None
    """Whether the domain's stand-in found it; None where there is none, or it raised something."""
    unmet: tuple[str, ...] = ()
    """What of the goal the stand-in left out at last."""
    idle: Mapping[tuple[str, str], bool] = field(default_factory=dict)
    """By action and parameter, whether other values of it have the same outcome."""
    look: Look | None = None
    """What it tells of itself."""
    pure: bool = True
    """Whether it keeps nothing to itself, as far as was seen."""
    asked: int = 0
    spent: float = 0.0
    """How many actions were prepared to be tried, and how long that took."""
    remade: Env | None = None
    """What became of the spare world, if the domain could use it."""
    raised: list[BaseException] = field(default_factory=list)
    """What was raised while actions were tried."""
    errors: list[BaseException] = field(default_factory=list)
    """What was raised while a planner, a stand-in or a search was at work."""
    verified: bool = False
    """Whether the domain has a verifier."""

    def __post_init__(self) -> None:
        self.start = self.env.reset()

    @cached_property
    def regions(self) -> Regions:
        """Where the domain would sample; nothing where one of its regions is none."""
        return usable_regions(self.domain, self.instance, self.env)

    @property
    def slow(self) -> bool:
        """Whether answers take so long that fewer questions must do."""
        return self.spent > SLOW * self.asked

    def bounded(self, count: int) -> int:
        """So many, or a few where answers take long."""
        return min(count, FEW) if self.slow else count

    def again(self, trials: Sequence[Trial]) -> list[Trial]:
        """Those of the trials that are asked again."""
        return spread(trials, self.bounded(len(trials)))

    @property
    def skeleton(self) -> tuple[Sketch, ...]:
        """The domain's action sequence; empty if it has none."""
        return tuple(self.domain.skeleton(self.instance) or ())

    @property
    def witness(self) -> tuple[Action, ...] | None:
        """What the domain knows to solve it; it is asked for problems of its settings only."""
        return self.domain.witness(self.setting, self.seed) if self.setting in self.domain.settings else None

    @property
    def applied(self) -> list[Trial]:
        """What could be carried out."""
        return [trial for trial in self.trials if trial.transition is not None]

    @property
    def refused(self) -> list[Trial]:
        """What could not."""
        return [trial for trial in self.trials if trial.failure is not None]

    @property
    def queries(self) -> list[Query]:
        """What needed a motion: some of each kind of action, as a look at each is dear."""
        return self.some_queries(QUERIES)

    def some_queries(self, count: int) -> list[Query]:
        """What needed a motion: so many of each kind of action."""
        kinds: dict[str, list[Query]] = {}
        for trial in self.trials:
            if isinstance(trial.answer, MotionProblem) and not trial.malformed:
                kinds.setdefault(trial.action.name, []).append((trial, trial.answer))
        return [query for of_kind in kinds.values() for query in spread(of_kind, count)]

    @property
    def malformed(self) -> list[Query]:
        """Motion problems whose validity test does not answer as it should."""
        return [(t, t.answer) for t in self.trials if isinstance(t.answer, MotionProblem) and t.malformed]

    @property
    def states(self) -> list[State]:
        """The initial state, and those that actions led to, each once."""
        after = [trial.transition.state for trial in self.applied if isinstance(trial.transition, Transition)]
        return list(dict.fromkeys([self.start, *(state for state in after if isinstance(state, State))]))


def spread(items: Sequence[T], count: int) -> list[T]:
    """So many of the items, the first and the last among them."""
    return [items[i] for i in sorted({round(i) for i in np.linspace(0, len(items) - 1, count)})] if items else []


def prepared(env: Env, state: State, action: Action) -> MotionProblem | NoMotion | Failure:
    """The Env's answer, with a generator that depends on the question alone."""
    return env.prepare(state, action, generator("check", state, action))


def tried(world: World, state: State, action: Action) -> Trial:
    """Carry an action out as a rollout does."""
    began = world.clock()
    answer = prepared(world.env, state, action)
    world.asked, world.spent = world.asked + 1, world.spent + world.clock() - began
    if isinstance(answer, Failure):
        return Trial(state, action, answer, failure=answer)
    motion = Motion()
    if isinstance(answer, MotionProblem):
        if malformed(answer):
            return Trial(state, action, answer, malformed=True)
        if world.helpers.planner is None:
            return Trial(state, action, answer)
        try:
            path = world.helpers.planner.plan(answer, generator("plan", state, action))
        except Exception as error:  # a rule can say more of what is wrong with the problem
            world.errors.append(error)
            return Trial(state, action, answer)
        if not isinstance(path, Path):
            return Trial(state, action, answer, failure=path)
        motion = answer.motion(path)
    elif not isinstance(answer, NoMotion):
        return Trial(state, action, answer)
    return Trial(state, action, answer, False, None, motion, world.env.apply(state, action, motion))


def applied(env: Env, trial: Trial) -> Transition | None:
    """Where the action leads once more, maybe in another world; None if it was not carried out."""
    if trial.motion is None or trial.transition is None:
        return None
    return env.apply(trial.state, trial.action, trial.motion)
