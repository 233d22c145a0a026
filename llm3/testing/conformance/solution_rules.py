"""Rules for what a domain tells of solutions: a sequence, pieces of one, and actions that solve a problem."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from llm3.rollout import Roller
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.world import World
from llm3.types import Action, Sketch
from llm3.verification import fault
from llm3.wording import failure_in_words


def the_skeleton_is_made_of_known_actions(world: World) -> Iterator[Fault]:
    """Each sketch names an action of the schemas, with as many objects, which there are."""
    yield from _unknown(world, world.skeleton, "the skeleton holds", "It is a tuple of llm3.types.Sketch.")


def the_pieces_are_made_of_known_actions(world: World) -> Iterator[Fault]:
    """Each piece is made of sketches, which name actions of the schemas, with as many objects, which there are."""
    cause = "It is a tuple of pieces, and a piece is a tuple of llm3.types.Sketch."
    for piece in world.domain.pieces(world.instance) or ():
        if not isinstance(piece, tuple):
            yield Fault(f"one of the pieces is {piece!r}.", cause)
        else:
            yield from _unknown(world, piece, "a piece holds", cause)


def _unknown(world: World, sketches: Iterable[Sketch], where: str, form: str) -> Iterator[Fault]:
    schemas = {schema.name: schema for schema in world.env.schemas}
    for sketch in sketches:
        if not isinstance(sketch, Sketch):
            yield Fault(f"{where} {sketch!r}.", form)
            continue
        schema = schemas.get(sketch.name)
        unknown = [name for name in sketch.objects if name not in world.env.objects]
        if schema is None or len(schema.objects) != len(sketch.objects) or unknown:
            known = ", ".join(f"{s.name}({', '.join(s.objects)})" for s in schemas.values())
            yield Fault(
                f"{where} {sketch}, which is no action of this world.",
                f"Actions are {known}, and objects {', '.join(world.env.objects) or 'none'}.",
            )


def the_witness_solves_the_problem(world: World) -> Iterator[Fault]:
    """The actions of a witness are such as a model may write, work one after another, and reach the goal."""
    actions = world.witness
    if actions is None:
        return
    if not isinstance(actions, tuple) or not all(isinstance(action, Action) for action in actions):
        yield Fault(f"witness must answer a tuple of Action or None, not {actions!r}.", "A tuple of one needs a comma.")
        return
    if actions != world.witness:
        yield Fault("witness answers differently when it is asked again.", "Make it along with the instance.")
        return
    for action in actions:
        reason = fault(world.env, action)
        if reason:
            yield Fault(
                f"the witness holds {action}, which is no action of this world: {reason}.",
                "Round parameters, and keep them within the ranges of the schema.",
            )
            return
    if world.helpers.planner is None:
        return
    rolled = Roller(world.env, world.helpers.planner, 0, world.clock).rollout(world.start, actions)
    failed = next((outcome for outcome in rolled.outcomes if outcome.failure), None)
    if failed and failed.failure:
        yield Fault(
            f"the witness does not solve the problem: {failed.action}: {failure_in_words(failed.failure)}.",
            "What made the instance believes in more room or reach than there is with the default options.",
        )
    elif not world.env.goal(rolled.state).achieved:
        unmet = "; ".join(world.env.goal(rolled.state).unmet)
        yield Fault(f"the witness does not solve the problem: at its end, {unmet}.", "It must reach the whole goal.")


RULES = (
    the_skeleton_is_made_of_known_actions,
    the_pieces_are_made_of_known_actions,
)
DEAR_RULES = (the_witness_solves_the_problem,)
"""Looked at in the first problem of each setting only."""
