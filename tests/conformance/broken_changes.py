"""Yards that do not tell what changes, or change what makes no sense; and exceptions on the way."""

from __future__ import annotations

from dataclasses import replace

from broken_answers import with_query
from planted import Planted
from yard import Yard, a_yard

from llm3 import Option
from llm3.types import Entity, Goal, GoalStatus, Held, Pose, Segment, Transition

GRASP = Pose((0.0, 0.0, 0.0))


def with_cup(where):
    """A description in which the cup is told of by a function of the state."""
    return lambda self, state: tuple(
        Entity("cup", {"position": where(self, state)}) if entity.name == "cup" else entity
        for entity in Yard.describe(self, state)
    )


def at_first(self, state):
    return "in the hand" if state.held else Yard.reset(self).poses["cup"].position


def beside_the_robot(self, state):
    return "east of the wall" if state.configuration[0] > 1 else "west of the wall"


def shaken(self, state, action, motion):
    """The bell makes the cup slide."""
    after = Yard.apply(self, state, action, motion).state
    if action.name != "ring" or not after.poses:
        return Transition(after)
    x, y, z = after.poses["cup"].position
    return Transition(replace(after, poses={"cup": Pose((x + 0.02, y, z))}))


def taking_anything(self, state, action, motion):
    after = Yard.apply(self, state, action, motion).state
    if action.name != "take":
        return Transition(after)
    (name,) = action.objects
    poses = {other: pose for other, pose in state.poses.items() if other != name}
    return Transition(replace(after, poses=poses, held=Held(name, GRASP)))


def beyond(self, state, goal, **others):
    away = Segment("retreat", (goal.then[-1].waypoints[-1], (2.5, 0.5)), goal.then[-1].events)
    return Yard.problem(self, state, Goal(goal.configuration, (*goal.then[:-1], away)))


def both_ways(self, state):
    return GoalStatus(True, ("the bell has not been rung",))


def no_green_cups(self, instance, options):
    return {"red": Yard}[options["colour"]](instance)


FAULTS: dict[str, Planted] = {
    "cup that is told of where it was at first": Planted(
        a_yard(describe=with_cup(at_first)),
        "the description follows the state",
        "put(['cup'], {…}) changes where 'cup' is, and the description with that alone changed is the same.",
        "state.poses",
    ),
    "cup that is never in the hand": Planted(
        a_yard(describe=with_cup(beside_the_robot)),
        "the description follows the state",
        "take(['cup'], {}) changes whether 'cup' is held, and the description with that alone changed is the same.",
        "state.held",
    ),
    "bell that shakes the cup": Planted(
        a_yard(apply=shaken, describe=with_cup(at_first)),
        "the description follows the state",
        "ring([], {}) changes where 'cup' is, and the description with that alone changed is the same.",
        "state.poses",
    ),
    "wall in the hand": Planted(
        a_yard(objects=("cup", "wall"), apply=taking_anything),
        "what is taken was somewhere",
        "take(['wall'], {}) picks up 'wall', which stood nowhere.",
        "as a PRECONDITION",
    ),
    "retreat beyond the limits": Planted(
        a_yard(problem=beyond),
        "limits hold what follows a goal",
        "the piece 'retreat' of … goes to (2.5, 0.5), outside of (0, 0) to (2, 1).",
        "UNREACHABLE",
    ),
    "one verdict too few": Planted(
        with_query(valid=lambda env: lambda Q: env.free(Q)[1:]),
        "validity is one answer a configuration",
        "the validity test of take(['cup'], {}) answers bool (25,) for configurations of shape (26, 2).",
        "one for each row",
    ),
    "a verdict for each joint": Planted(
        with_query(valid=lambda env: lambda Q: ((Q >= 0) & env.free(Q)[:, None]).all(axis=0)),
        "validity is one answer a configuration",
        "the validity test of take(['cup'], {}) answers bool (2,) for configurations of shape (26, 2).",
        "one for each row",
    ),
    "goal that is reached and is not": Planted(
        a_yard(goal=both_ways),
        "nothing is raised",
        "Yard.both_ways raised ValueError: a goal is either achieved or has unmet parts: name each of them in `unmet` "
        "(broken_changes.py:…).",
        "The sentence says what GoalStatus takes.",
    ),
    "pose in the plane": Planted(
        a_yard(prepare=lambda self, state, action, rng: Pose((0.1, 0.2))),
        "nothing is raised",
        "small, seed 0, …: Yard.<lambda> raised ValueError: a pose has a position of 3 numbers and an orientation of 4 "
        "(x, y, z, w) (broken_changes.py:…).",
        "The sentence says what Pose takes.",
    ),
    "choice that makes no world": Planted(
        a_yard(
            options=(
                Option("floor", "dry", "what it stands on"),
                Option("colour", "red", "of the cup", ("red", "green")),
            ),
            make=no_green_cups,
        ),
        "every choice of an option makes a world",
        "with colour=green no world of 'small', seed 0, is made: KeyError: 'green' (broken_changes.py:…).",
        "take it out of the choices",
    ),
}
