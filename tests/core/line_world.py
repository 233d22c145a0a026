"""A robot on a line: the smallest world in which everything can happen, and nothing happens by chance.

What becomes of an action is written down beforehand, so that a test can say what it expects: `trouble` names the
targets that the world refuses, `slippery` those where the robot slides on, and the planner is told how often it finds
no path. Paths are random, as a sampling planner's are, and show which generator they were drawn with.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache

import numpy as np

from llm3 import (
    Budget,
    Domain,
    Env,
    FeedbackSynthesizer,
    MotionPlanner,
    Option,
    Prompt,
    Registry,
    Strategy,
    hookimpl,
    solve,
)
from llm3.interfaces import Joint
from llm3.testing import ScriptedLLM
from llm3.types import (
    Action,
    ActionSchema,
    Entity,
    Failure,
    FailureKind,
    Feedback,
    Goal,
    GoalStatus,
    MotionProblem,
    NoMotion,
    Parameter,
    Path,
    Remark,
    Sketch,
    State,
    Stats,
    Transition,
)

PREPARED = Stats(ik_calls=2, validity_checks=3)
"""What the world says that it spent on one action."""
PLANNED = Stats(planner_calls=1, planner_iterations=5)
"""What the planner says that it spent on one query."""
FINISH = 9.0
"""The goal: the robot stands here."""


def go(x):
    return Action("go", (), {"x": x})


def take(thing):
    return Action("take", (thing,))


def reply(*plan):
    """What a model would write; an item is an action or any text."""
    return json.dumps({"Reasoning": "because", "Full Plan": [str(item) for item in plan]})


class Line(Env):
    """A robot at 0 that has to get to 9. At 1 lies a coin, which it takes without a motion."""

    task = "A robot stands on a line at x = 0. It has to get to x = 9."
    schemas = (
        ActionSchema("go", (), (Parameter("x", 0, 10, "m"),), "roll to x"),
        ActionSchema("take", ("thing",), (), "pick up the thing where the robot stands"),
    )
    objects = ("coin",)
    joints = (Joint("wheel", "m"),)

    def __init__(
        self,
        trouble: Mapping[float, FailureKind | None] | None = None,
        slippery: Mapping[float, float] | None = None,
        start: float = 0.0,
    ):
        self.trouble, self.slippery, self.start = dict(trouble or {}), dict(slippery or {}), start
        self.asked: list[tuple[State, Action, int]] = []
        """Every action that was prepared, with the first number of its generator."""
        self.closed = 0

    def reset(self):
        return State(configuration=(self.start,), facts={"coin": False})

    def describe(self, state):
        return Entity("robot", {"x": state.configuration[0]}), Entity("coin", {"x": 1.0})

    def prepare(self, state, action, rng):
        self.asked.append((state, action, int(rng.integers(2**62))))
        if action.name == "take":
            if state.configuration != (1.0,):
                return Failure(FailureKind.PRECONDITION, "the robot is not where the coin is", stats=PREPARED)
            return NoMotion(PREPARED)
        target = action.params["x"]
        if kind := self.trouble.get(target):
            return Failure(kind, objects=("wall",), stats=PREPARED)
        everywhere = lambda Q: np.ones(len(Q), dtype=bool)  # noqa: E731  # it is a value here
        return MotionProblem(state.configuration, (Goal((target,)),), 0.0, 10.0, everywhere, 0.1, stats=PREPARED)

    def apply(self, state, action, motion):
        if action.name == "take":
            return Transition(State(configuration=state.configuration, facts={"coin": True}))
        (x,) = motion.end
        slide = self.slippery.get(x, 0.0)
        notes = (f"the robot slid {slide:g} m",) if slide else ()
        return Transition(State(configuration=(x + slide,), facts=state.facts), notes)

    def goal(self, state):
        arrived = state.configuration == (FINISH,)
        return GoalStatus(arrived, () if arrived else ("the robot is not at the finish",))

    def close(self):
        self.closed += 1


@dataclass
class Detour(MotionPlanner):
    """Goes to the goal by way of a random point.

    `no_path` says how often no path to a target is found before one is; `refuses` what always fails, and why.
    """

    no_path: dict[float, int] = field(default_factory=dict)
    refuses: Mapping[float, FailureKind] = field(default_factory=dict)
    stats: Stats = PLANNED

    def plan(self, problem, rng):
        target = problem.goals[0].configuration[0]
        if kind := self.refuses.get(target):
            return Failure(kind, stats=self.stats)
        if self.no_path.get(target, 0) > 0:
            self.no_path[target] -= 1
            return Failure(FailureKind.NO_PATH, stats=self.stats)
        between = rng.uniform(0.0, 10.0)
        return Path(np.array([problem.start, [between], [target]]), stats=self.stats)


class Gamble(MotionPlanner):
    """Finds a path in one of two cases, as the generator has it: the same generator, the same answer."""

    def plan(self, problem, rng):
        if rng.uniform() < 0.5:
            return Failure(FailureKind.NO_PATH, stats=PLANNED)
        return Detour().plan(problem, rng)


class Plain(FeedbackSynthesizer):
    """Says the kind of each failure, and every note."""

    def synthesize(self, attempt):
        if attempt.unreadable:
            return Feedback(attempt.number, summary=attempt.unreadable.detail)
        remarks = tuple(
            Remark(
                str(outcome.action),
                "failed" if outcome.failure else "feasible",
                " ".join([*([outcome.failure.kind.value] if outcome.failure else []), *outcome.notes]),
            )
            for outcome in attempt.outcomes
        )
        return Feedback(attempt.number, remarks, "; ".join(attempt.goal.unmet))


class Mute(FeedbackSynthesizer):
    """Says nothing."""

    def synthesize(self, attempt):
        return None


class TickingClock:
    """A second passes with every look at it."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        self.now += 1.0
        return self.now


BACKTRACK = Strategy("llm3_templates", "backtrack.j2")
SAMPLE_PARAMS = Strategy("llm3_templates", "sample-params.j2", fixed_sequence=True)


load_prompt = cache(Prompt)


def play(*script, env=None, planner=None, feedback=None, strategy=BACKTRACK, budget=None, **arguments):
    """Solve with these replies; `arguments` go to `solve`. Without a budget it ends with the script."""
    model = arguments.pop("backend", None) or ScriptedLLM(script)
    return solve(
        env or Line(),
        backend=model,
        planner=planner or Detour(),
        feedback=feedback or Plain(),
        prompt=load_prompt(strategy),
        budget=budget or Budget(max_llm_calls=max(len(script), 1)),
        **arguments,
    )


# ---- the same world as a plugin ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class LineInstance:
    start: float

    def __post_init__(self):
        if not 0 <= self.start <= 10:
            raise ValueError(f"start must be from 0 to 10, not {self.start}")


class LineDomain(Domain):
    name = "line"
    description = "A robot on a line."
    settings = ("far", "near")
    default_setting = "far"
    options = (Option("ground", "dry", "how slippery it is", ("dry", "wet")), Option("colour", "red", "of the robot"))
    instance_type = LineInstance

    def instance(self, setting, seed):
        return LineInstance(float(seed % 5) + (5.0 if setting == "near" else 0.0))

    def make(self, instance, options):
        return Line(start=instance.start, slippery={8.0: 1.0} if options["ground"] == "wet" else {})


class FullLineDomain(LineDomain):
    """The domain with every capability."""

    name = "full-line"

    def skeleton(self, instance):
        return (Sketch("go"), Sketch("take", ("coin",)), Sketch("go"))

    def regions(self, instance):
        return {("go", (), "x"): (8.5, 9.5)}

    def stand_in(self):
        return lambda context, rng: reply(go(FINISH))


class LinePlugin:
    """Registers the world, bare and full, and its planner and words."""

    @hookimpl
    def llm3_domains(self):
        return {"line": LineDomain, "full-line": FullLineDomain}

    @hookimpl
    def llm3_planners(self):
        return {"birrt": lambda settings: Detour()}

    @hookimpl
    def llm3_feedback(self):
        return {"categorized": Plain, "none": Mute}


def line_registry():
    """The world's plugin beside the shipped strategies and stand-ins."""
    import llm3_standins.plugin
    import llm3_templates.plugin

    registry = Registry()
    registry.register(LinePlugin(), "line (test)")
    registry.register(llm3_templates.plugin, "templates (test)")
    registry.register(llm3_standins.plugin, "standins (test)")
    return registry
