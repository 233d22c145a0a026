"""What is worth knowing of a domain's worlds, and need not be wrong."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import dist

from llm3.seeding import generator
from llm3.testing.conformance.changes import MOVED
from llm3.testing.conformance.motion_rules import NO_EXPLANATION
from llm3.testing.conformance.values import difference
from llm3.testing.conformance.world import Trial, World, spread
from llm3.types import Action, ActionSchema, Parameter, Transition

TRIED = 3
"""How many actions are asked for again with another value of a parameter."""


def remarks(worlds: Sequence[World]) -> Iterator[str]:
    """All of them, in sentences."""
    yield from _kinds(worlds)
    if any(problem.explain is NO_EXPLANATION for world in worlds for _, problem in world.queries):
        yield "A motion problem has no explain, so a planner cannot tell a model what is in the way."
    yield from _unsolved(worlds)
    yield from _idle(worlds)
    for kind in dict.fromkeys(trial.action.name for world in worlds for trial in world.applied):
        moved = (m for world in worlds for trial in world.applied if trial.action.name == kind for m in _moved(trial))
        yield from list(moved)[:1]


def _kinds(worlds: Sequence[World]) -> Iterator[str]:
    """Kinds of actions of which one outcome was never seen."""
    for name, schema in _schemas(worlds).items():
        trials = [trial for world in worlds for trial in world.trials if trial.action.name == name]
        if trials and not any(trial.transition is not None for trial in trials):
            yield f"None of {len(trials)} {name!r} actions that were tried could be carried out."
        open_to_choice = schema.objects or schema.parameters
        if trials and open_to_choice and not any(trial.failure for trial in trials):
            yield f"None of {len(trials)} {name!r} actions that were tried was refused."


def _unsolved(worlds: Sequence[World]) -> Iterator[str]:
    looked = [world for world in worlds if world.helpers.planner is not None]
    unsolved = [world.where for world in looked if world.result is None]
    if unsolved and len(unsolved) == len(looked):
        yield f"In no world was the goal reached, so whether it can be is not known: {'; '.join(unsolved)}."
    elif unsolved:
        yield f"No plan that reaches the goal was found in some worlds: {'; '.join(unsolved)}."


def _idle(worlds: Sequence[World]) -> Iterator[str]:
    for name, schema in _schemas(worlds).items():
        for parameter in schema.parameters:
            verdicts = [world.idle[name, parameter.name] for world in worlds if (name, parameter.name) in world.idle]
            if verdicts and all(verdicts):
                yield (
                    f"Parameter {parameter.name!r} of {name!r} changes nothing in what becomes of the actions that "
                    "were tried."
                )


def idle_parameters(world: World) -> dict[tuple[str, str], bool]:
    """By action and parameter, whether other values of it have no other outcome than those that were tried."""
    found: dict[tuple[str, str], bool] = {}
    for schema in world.env.schemas:
        trials = [trial for trial in world.applied if trial.action.name == schema.name]
        for parameter in schema.parameters if trials else ():
            some = spread(trials, 1 if world.slow else TRIED)
            found[schema.name, parameter.name] = not any(_matters(world, trial, parameter) for trial in some)
    return found


def _matters(world: World, trial: Trial, parameter: Parameter) -> bool:
    for end in (parameter.low, parameter.high):
        if end == trial.action.params[parameter.name]:
            continue
        other = Action(trial.action.name, trial.action.objects, {**trial.action.params, parameter.name: end})
        rng = generator("check", trial.state, trial.action)  # the same one, so that nothing else can differ
        if difference(trial.answer, world.env.prepare(trial.state, other, rng)):
            return True
        if trial.motion and difference(trial.transition, world.env.apply(trial.state, other, trial.motion)):
            return True
    return False


def _moved(trial: Trial) -> Iterator[str]:
    """What else an action moves, without a word."""
    if not isinstance(trial.transition, Transition):
        return
    before, after, notes = trial.state, trial.transition.state, " ".join(trial.transition.notes)
    for name, pose in after.poses.items():
        own = name in trial.action.objects or name in notes
        if not own and name in before.poses and (far := dist(pose.position, before.poses[name].position)) > MOVED:
            yield f"{trial} moves {name!r}, too, by {far:.2g} m, and no note tells of it."


def _schemas(worlds: Sequence[World]) -> dict[str, ActionSchema]:
    return {schema.name: schema for world in worlds if world.look for schema in world.look.schemas}
