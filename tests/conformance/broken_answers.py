"""Yards whose answers are wrong, or depend on more than they may."""

from __future__ import annotations

import random
from dataclasses import replace
from itertools import count

import numpy as np
from planted import Planted
from yard import Yard, a_yard, with_state

from llm3.types import Entity, Failure, FailureKind, Goal, GoalStatus, Held, MotionProblem, Pose, Segment, Transition


def with_query(**fields):
    """A yard whose motion problems have other fields; each is made by a function of the Env."""

    def problem(self, state, goal, **others):
        return Yard.problem(self, state, goal, **{name: make(self) for name, make in fields.items()})

    return a_yard(problem=problem)


def with_failure(*arguments, **fields):
    """A yard in which ringing fails."""

    def prepare(self, state, action, rng):
        return Failure(*arguments, **fields) if action.name == "ring" else Yard.prepare(self, state, action, rng)

    return a_yard(prepare=prepare)


def counting():
    """A prepare that counts its calls."""
    calls = count()

    def prepare(self, state, action, rng):
        answer = Yard.prepare(self, state, action, rng)
        return replace(answer, label=f"way {next(calls)}") if isinstance(answer, MotionProblem) else answer

    return prepare


def remembering(self, state, action, rng):
    """Prepares from where apply left the robot, and not from the state."""
    here = getattr(self, "here", state.configuration)
    return Yard.prepare(self, replace(state, configuration=here), action, rng)


def moving(self, state, action, motion):
    """Applies, and keeps where the robot is."""
    after = Yard.apply(self, state, action, motion)
    self.here = after.state.configuration
    return after


def lingering(self, state, action, rng):
    """Prepares, and keeps the state of the last call, which `looking` looks at."""
    self.now = state
    return Yard.prepare(self, state, action, rng)


def looking(self, Q):
    return Yard.free(self, Q) & ((Q[:, 1] < 0.8) | (not self.now.facts["rung"]))


def drawing(self, state, action, rng):
    random.random()
    return Yard.prepare(self, state, action, rng)


def counting_refusals(self, state, action, rng):
    answer = Yard.prepare(self, state, action, rng)
    self.refusals = getattr(self, "refusals", 0) + isinstance(answer, Failure)
    return answer


def telling_of_refusals(self, state):
    return (*Yard.describe(self, state), Entity("log", {"refusals": getattr(self, "refusals", 0)}))


def shaking(self, state, action, motion):
    return replace(Yard.apply(self, state, action, motion), notes=(f"the cup shook {random.random()} times",))


def numbered():
    """The making of an Env that differs from the last one."""
    worlds = count()

    def init(self, instance):
        Yard.__init__(self, instance)
        self.task = f"{Yard.task} This is yard {next(worlds)}."

    return init


def sharing():
    """Envs that share something, which the first one that is closed takes with it."""
    shared = {"open": True}

    def prepare(self, state, action, rng):
        answer = Yard.prepare(self, state, action, rng)
        return answer if shared["open"] else Failure(FailureKind.UNREACHABLE, "the simulator is gone")

    def close(self):
        shared["open"] = False

    return a_yard(prepare=prepare, close=close)


def closing_once(self):
    del self.instance


def raising(self, state, action, rng):
    return Yard.prepare(self, state, action, rng) if action.name != "put" else {}["nothing"]


def jumping(self, state, goal):
    there = Segment("approach", ((0.5, 0.5), (0.6, 0.5)))
    return Yard.problem(self, state, Goal(goal.configuration, (there, *goal.then)))


def elsewhere(self, state, goal):
    return replace(Yard.problem(self, state, goal), start=np.array((0.2, 0.2)))


def far_away(self, state, goal):
    return Yard.problem(self, state, Goal((goal.configuration[0], goal.configuration[1] + 1.0)))


def putting_anyway(self, state, action, rng):
    """Puts the cup without a look at the hand."""
    held = Held("cup", Pose((0.0, 0.0, 0.0)))
    state = replace(state, poses={}, held=held) if action.name == "put" else state
    return Yard.prepare(self, state, action, rng)


def losing(**fields):
    """An apply whose states lose something."""
    return lambda self, state, action, motion: Transition(
        replace(Yard.apply(self, state, action, motion).state, **fields)
    )


OF_MORE: dict[str, Planted] = {
    "counts its calls": Planted(
        a_yard(prepare=counting()),
        "prepare depends on its arguments alone",
        "prepare answers … differently the second time: label is 'way …' and then 'way …'.",
        "counts its calls",
    ),
    "remembers where the robot was": Planted(
        a_yard(prepare=remembering, apply=moving),
        "prepare depends on its arguments alone",
        "prepare answers … differently the second time: start is […] and then […].",
        "Keep nothing in the Env",
    ),
    "looks at the last state": Planted(
        a_yard(prepare=lingering, free=looking),
        "a motion problem stays what it is",
        "the validity test of … answers (…) differently after preparing ….",
        "bind it to the state of its own prepare",
    ),
    "draws from everybody's generator": Planted(
        a_yard(prepare=drawing),
        "chance comes from the generator that is given",
        "preparing and applying actions draws from the global generator of random or numpy.",
        "the rng that prepare is given",
    ),
    "changes before it refuses": Planted(
        a_yard(prepare=counting_refusals, describe=telling_of_refusals),
        "a refused action changes nothing",
        "describe answers differently after …, which was refused: …",
        "prepare only asks",
    ),
    "notes without a seed": Planted(
        a_yard(apply=shaking),
        "apply depends on its arguments alone",
        "apply answers … differently the second time: notes is (…) and then (…).",
        "Keep nothing",
    ),
    "worlds that are numbered": Planted(
        a_yard(__init__=numbered()),
        "two worlds of one instance are equal",
        "a second world differs: task is …ring the bell. This is yard 0.' and then …This is yard 1.'.",
        "take all of it from the instance",
    ),
    "worlds that share a simulator": Planted(
        sharing(),
        "closing twice does no harm",
        "once one world is closed, another one prepares … differently: it is a … and then a Failure.",
        "each needs its own",
    ),
    "closed only once": Planted(
        a_yard(close=closing_once),
        "nothing is raised",
        "Yard.closing_once raised AttributeError: …",
        "ends a run",
    ),
}
OF_PREPARE: dict[str, Planted] = {
    "raises": Planted(
        a_yard(prepare=raising),
        "nothing is raised",
        "small, seed 0, put(['cup'], {…}): Yard.raising raised KeyError: 'nothing' (broken_answers.py:…).",
        "is a Failure, and not an exception",
    ),
    "no answer": Planted(
        a_yard(prepare=lambda self, state, action, rng: None),
        "prepare answers what it may",
        "prepare answers … with None.",
        "must return",
    ),
    "failure of the planner": Planted(
        with_failure(FailureKind.NO_PATH, "no way"),
        "prepare answers what it may",
        "prepare answers ring([], {}) with the failure 'no path within budget'.",
        "the planner and the parser",
    ),
    "no reason": Planted(
        with_failure(FailureKind.PRECONDITION),
        "failures say why",
        "ring([], {}) fails for a precondition, and does not say which.",
        "what would have to be true",
    ),
    "nothing to blame": Planted(
        with_failure(FailureKind.GOAL_IN_COLLISION),
        "failures say why",
        "ring([], {}) fails with 'goal in collision', and does not say with what.",
        "Failure.objects",
    ),
    "blames a stranger": Planted(
        with_failure(FailureKind.GOAL_IN_COLLISION, objects=("body_17",)),
        "failures name what the model knows",
        "the failure of ring([], {}) blames 'body_17', which neither the description nor the task names.",
        "bell, cup, robot, wall",
    ),
    "nothing works": Planted(
        a_yard(prepare=lambda self, state, action, rng: Failure(FailureKind.UNREACHABLE)),
        "something can be done",
        "none of … actions could be carried out: unreachable.",
        "regions",
    ),
}
OF_MOTION_PROBLEMS: dict[str, Planted] = {
    "starts elsewhere": Planted(
        a_yard(problem=elsewhere),
        "a motion begins where the robot is",
        "… starts at (0.2, 0.2), and the robot is at (…).",
        "state.configuration",
    ),
    "endless limits": Planted(
        with_query(high=lambda env: np.array((2.0, np.inf))),
        "limits hold what follows a goal",
        "the limits of … are (0, 0) to (2, inf).",
        "finite limits",
    ),
    "goal outside of the limits": Planted(
        a_yard(problem=far_away),
        "nothing is raised",
        "small, seed 0, …: Yard.prepare raised ValueError: joint value 1 of a goal is …, outside of its limits 0 to 1: "
        "refuse an action that would need it, or widen `low` and `high` (yard.py:…).",
        "The sentence says what MotionProblem takes.",
    ),
    "coarse resolution": Planted(
        with_query(resolution=lambda env: 0.5),
        "the resolution is fine",
        "the resolution of … is (0.5, 0.5) in ranges of (2, 1).",
        "finer than the obstacles",
    ),
    "one verdict for all": Planted(
        with_query(valid=lambda env: lambda Q: bool(env.free(Q).all())),
        "validity is one answer a configuration",
        "the validity test of … answers … for configurations of shape (…, 2).",
        "one configuration a row",
    ),
    "verdicts that depend on the others": Planted(
        with_query(valid=lambda env: lambda Q: env.free(Q) | (len(Q) > 1)),
        "validity is one answer a configuration",
        "the validity test of … answers (…) differently alone and among others.",
        "wrong axis",
    ),
    "changes what it is asked about": Planted(
        with_query(valid=lambda env: lambda Q: env.free(np.add(Q, 0.001, out=Q))),
        "validity is one answer a configuration",
        "the validity test of … changes the configurations that it is given.",
        "copy",
    ),
    "start in collision": Planted(
        with_query(valid=lambda env: lambda Q: env.free(Q) & (Q[:, 0] > 0.15)),
        "the robot can leave its start",
        "the robot stands at (0.1, 0.5) in collision, says the validity test of ….",
        "move the start",
    ),
    "nothing is explained": Planted(
        with_query(explain=lambda env: lambda q: ()),
        "what is not free is explained",
        "explain of … finds nothing at (…), which is not free by valid.",
        "the same things",
    ),
    "too much is explained": Planted(
        with_query(explain=lambda env: lambda q: Yard.explain(env, np.array((1.0, env.instance.gap + 0.3)))),
        "what is not free is explained",
        "explain of … finds wall at (…), which is free by valid.",
        "the same distance",
    ),
    "certain where it is not": Planted(
        with_query(uncertain=lambda env: lambda start, end, steps: np.zeros(steps + 1, dtype=bool)),
        "what is uncertain holds all that is not free",
        "uncertain of … leaves out (…), which is not free.",
        "certainly free",
    ),
    "a jump": Planted(
        a_yard(problem=jumping),
        "goals lead on without a jump",
        "the piece 'approach' after a goal of … begins at (0.5, 0.5), and the robot is at (…).",
        "begin with the goal's configuration",
    ),
}
OF_APPLY: dict[str, Planted] = {
    "a bare state": Planted(
        a_yard(apply=lambda self, state, action, motion: Yard.apply(self, state, action, motion).state),
        "apply answers a transition",
        "apply answers … with State(…).",
        "Transition(state, notes)",
    ),
    "the robot stays behind": Planted(
        with_state(lambda before, after: replace(after, configuration=before.configuration)),
        "the robot is where its motion ends",
        "after … the robot is at (0.1, 0.5), and its motion ends at (…).",
        "motion.end",
    ),
    "the cup is lost": Planted(
        a_yard(
            apply=losing(held=None),
            describe=lambda self, state: (self.wall(), Entity("robot", {"at": state.configuration})),
        ),
        "no object and no fact gets lost",
        "after take(['cup'], {}) 'cup' is neither somewhere nor held.",
        "the whole next state",
    ),
    "the facts are lost": Planted(
        a_yard(
            apply=losing(facts={}),
            describe=lambda self, state: (Entity("cup"), Entity("robot", {"at": state.configuration})),
            goal=lambda self, state: GoalStatus(False, ("the bell has not been rung",)),
        ),
        "no object and no fact gets lost",
        "after … all facts are gone: {'rung': False}.",
        "facts=state.facts",
    ),
    "another grasp": Planted(
        with_state(
            lambda before, after: (
                replace(after, held=Held("cup", Pose((0.0, 0.0, 0.1)))) if after.held and not before.held else after
            )
        ),
        "the grip is what the events say",
        "take(['cup'], {}) attaches 'cup' with the grasp (0, 0, 0) (0, 0, 0, 1), and the state after it holds it with "
        "(0, 0, 0.1) (0, 0, 0, 1).",
        "the same one",
    ),
    "puts what it does not hold": Planted(
        a_yard(prepare=putting_anyway),
        "the grip is what the events say",
        "put(['cup'], {…}) detaches 'cup', and what is held is None.",
        "as a PRECONDITION",
    ),
    "attached and not held": Planted(
        with_state(lambda before, after: replace(after, held=None, poses=before.poses)),
        "the grip is what the events say",
        "take(['cup'], {}) ends with 'cup' attached, and the state after it holds None.",
        "the same story",
    ),
}
FAULTS = OF_MORE | OF_PREPARE | OF_MOTION_PROBLEMS | OF_APPLY
