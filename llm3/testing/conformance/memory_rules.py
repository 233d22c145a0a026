"""Rules that find a world which remembers, and heals itself when it is reset or asked in the order of a run."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from itertools import chain

import numpy as np

from llm3.interfaces import Env
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.samples import places, telling
from llm3.testing.conformance.values import configuration, difference
from llm3.testing.conformance.world import Trial, World, applied, prepared, spread
from llm3.types import Action, Mask, MotionProblem, State, Vector

STATES = 12
"""How many states are described again and again."""
DISTURBANCES = 4
"""After how many actions everything is asked again."""
QUERIES = 2
"""How many motion problems of each kind of action are asked again."""
PLACES = 24
"""How many places of interest in other motion problems are asked about."""

REMEMBERED = (
    "Keep nothing in the Env that a call changes, unless as a cache that goes by all that the answer depends on: "
    "the whole State, and the action."
)


def describe_and_goal_look_at_the_state_that_they_are_given(world: World) -> Iterator[Fault]:
    """Of every state, describe and goal tell the same after a reset as after other actions, with no reset between."""
    env, states = world.env, spread(world.states, STATES)
    env.reset()
    first = [(env.describe(state), env.goal(state)) for state in states]
    for disturbance in _disturbances(world):
        for state, before in zip(states, first, strict=True):
            for name, a, b in zip(("describe", "goal"), before, (env.describe(state), env.goal(state)), strict=True):
                if found := difference(a, b):
                    yield Fault(
                        f"{name} of one state answers differently after {disturbance}: {found}.",
                        "Look at the state that is given, and at no field of the Env that another call sets.",
                    )
                    return


def a_motion_problem_stays_what_it_is(world: World) -> Iterator[Fault]:
    """What a motion problem says is free does not change when the world is reset, or other actions are done."""
    of_interest = spread(places(problem for _, problem in world.queries), PLACES)
    looks: list[tuple[Trial, MotionProblem, Vector, Mask]] = []
    for trial, _ in world.some_queries(QUERIES):
        problem = prepared(world.env, trial.state, trial.action)
        if isinstance(problem, MotionProblem):
            at = telling(problem, of_interest)
            looks.append((trial, problem, at, np.asarray(problem.valid(at.copy()))))
    prepared_last = [f"preparing {trial}" for trial, *_ in looks[-1:]]
    for disturbance in chain(prepared_last, _disturbances(world)):
        for trial, problem, at, before in looks:
            now = np.asarray(problem.valid(at.copy()))
            if not np.array_equal(now, before):
                where = at[np.flatnonzero(now != before)[0]]
                yield Fault(
                    f"the validity test of {trial} answers {configuration(where)} differently after {disturbance}.",
                    "valid looks at what the Env or its simulator holds now: bind it to the state of its own prepare.",
                )
                return


def a_new_world_answers_like_one_in_use(world: World) -> Iterator[Fault]:
    """Asked in another order, and before anything is carried out there, a new world answers the same."""
    if world.twin is None:
        return
    world.twin.reset()
    for what, ask, answer in _questions(world):
        found = difference(answer, ask(world.twin))
        if found and not _chance(world, ask):  # or it was made differently, which another rule tells
            text = f"a new world {what} differently than one in which actions were carried out: {found}."
            yield Fault(text, REMEMBERED)
        if found:
            return


Ask = Callable[[Env], object]


def _questions(world: World) -> Iterator[tuple[str, Ask, object]]:
    """What a new world is asked, the latest first, and what the one in use answers."""
    for state in reversed(spread(world.states, STATES)):
        for name, verb in (("describe", "describes"), ("goal", "tells the goal of")):
            ask = partial(_call, name, state)
            yield f"{verb} a state of {len(state.poses)} objects", ask, ask(world.env)
    of_interest = spread(places(problem for _, problem in world.queries), PLACES)
    looks = {id(trial): telling(problem, of_interest) for trial, problem in world.some_queries(QUERIES)}
    for trial in reversed(world.again(world.trials)):
        prepare = partial(_prepare, trial.state, trial.action)
        yield f"prepares {trial}", prepare, trial.answer
        if (at := looks.get(id(trial))) is not None and isinstance(trial.answer, MotionProblem):
            yield f"answers the validity test of {trial}", partial(_free, trial, at), trial.answer.valid(at.copy())


def _call(name: str, state: State, env: Env) -> object:
    return getattr(env, name)(state)


def _prepare(state: State, action: Action, env: Env) -> object:
    return prepared(env, state, action)


def _free(trial: Trial, at: Vector, env: Env) -> object:
    problem = prepared(env, trial.state, trial.action)
    return problem.valid(at.copy()) if isinstance(problem, MotionProblem) else problem


def _chance(world: World, ask: Ask) -> bool:
    """Whether two new worlds, of which nothing else was asked, answer differently as well."""
    return bool(difference(ask(world.another()), ask(world.another())))


def _disturbances(world: World) -> Iterator[str]:
    """Reset the world, prepare some actions and carry them out; say after each what was done."""
    world.env.reset()
    yield "a reset"
    for trial in spread(world.applied, DISTURBANCES):
        prepared(world.env, trial.state, trial.action)
        yield f"preparing {trial}"
        applied(world.env, trial)
        yield f"applying {trial}"


RULES = (
    describe_and_goal_look_at_the_state_that_they_are_given,
    a_motion_problem_stays_what_it_is,
    a_new_world_answers_like_one_in_use,
)
