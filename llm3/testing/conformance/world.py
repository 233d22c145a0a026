"""One problem of a domain, in two worlds that were made alike."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from llm3.errors import PluginError
from llm3.interfaces import Domain, Env, Options, Regions
from llm3.seeding import generator
from llm3.testing.conformance.helpers import Helpers
from llm3.testing.conformance.values import samples
from llm3.types import (
    Action,
    Failure,
    Mask,
    Motion,
    MotionProblem,
    NoMotion,
    Path,
    Result,
    Sketch,
    State,
    Transition,
)

QUERIES = 4
"""How many motion problems of each kind of action are looked at."""


@dataclass(frozen=True, eq=False)
class Trial:
    """What became of one action in one state."""

    state: State
    action: Action
    answer: MotionProblem | NoMotion | Failure
    """What `prepare` answered."""
    mask: Mask | None = None
    """What the validity test of a motion problem said at once, of its `samples`."""
    failure: Failure | None = None
    """Why it cannot be done, by the Env or by the planner; None if it can, or if there was no planner."""
    motion: Motion | None = None
    transition: Transition | None = None
    """Where it led; None if it was not carried out."""

    def __str__(self) -> str:
        return str(self.action)


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
    helpers: Helpers
    start: State = field(init=False)
    trials: list[Trial] = field(default_factory=list)
    result: Result | None = None
    """A solution, where one was found."""
    remade: Env | None = None
    """What became of the spare world, if the domain could use it."""
    errors: list[PluginError] = field(default_factory=list)
    """What a planner said of malformed problems."""
    verified: bool = False
    """Whether the domain has a verifier."""

    def __post_init__(self) -> None:
        self.start = self.env.reset()

    @property
    def regions(self) -> Regions:
        """Where the domain would sample."""
        found = self.domain.regions(self.instance)
        return found if isinstance(found, Mapping) else {}

    @property
    def skeleton(self) -> tuple[Sketch, ...]:
        """The domain's action sequence; empty if it has none."""
        return tuple(self.domain.skeleton(self.instance) or ())

    @property
    def applied(self) -> list[Trial]:
        """What could be carried out."""
        return [trial for trial in self.trials if trial.transition is not None]

    @property
    def refused(self) -> list[Trial]:
        """What could not."""
        return [trial for trial in self.trials if trial.failure is not None]

    @property
    def queries(self) -> list[tuple[Trial, MotionProblem]]:
        """What needed a motion: some of each kind of action, as a look at each is dear."""
        found: dict[str, list[tuple[Trial, MotionProblem]]] = {}
        for trial in self.trials:
            if isinstance(trial.answer, MotionProblem):
                found.setdefault(trial.action.name, []).append((trial, trial.answer))
        return [query for of_kind in found.values() for query in of_kind[:: max(1, len(of_kind) // QUERIES)][:QUERIES]]


def prepared(env: Env, state: State, action: Action) -> MotionProblem | NoMotion | Failure:
    """The Env's answer, with a generator that depends on the question alone."""
    return env.prepare(state, action, generator("check", state, action))


def tried(world: World, state: State, action: Action) -> Trial:
    """Carry an action out as a rollout does."""
    answer = prepared(world.env, state, action)
    if isinstance(answer, Failure):
        return Trial(state, action, answer, failure=answer)
    mask, motion = None, Motion()
    if isinstance(answer, MotionProblem):
        mask = answer.valid(samples(answer))
        if world.helpers.planner is None:
            return Trial(state, action, answer, mask)
        try:
            path = world.helpers.planner.plan(answer, generator("plan", state, action))
        except PluginError as error:  # the problem is malformed, of which a rule can say more
            world.errors.append(error)
            return Trial(state, action, answer, mask)
        if not isinstance(path, Path):
            return Trial(state, action, answer, mask, path)
        motion = answer.motion(path)
    elif not isinstance(answer, NoMotion):
        return Trial(state, action, answer)
    return Trial(state, action, answer, mask, None, motion, world.env.apply(state, action, motion))
