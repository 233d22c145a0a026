"""Rules for what a model may write: actions, objects, parameters."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, islice

from llm3.jsonio import dumps
from llm3.parsing import parse_reply
from llm3.seeding import generator
from llm3.testing.conformance.drawing import Drawing
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.world import World
from llm3.types import ActionSchema, Proposal, Rejected

READ = 400
"""How many actions are read back at most, so that each object stands once at each place."""


def schemas_tell_what_there_is_to_do(world: World) -> Iterator[Fault]:
    """Actions have different names, a description without a full stop, and ranges that leave a choice."""
    schemas = world.env.schemas
    if not isinstance(schemas, tuple) or not schemas or not all(isinstance(s, ActionSchema) for s in schemas):
        text = f"schemas must be a tuple of ActionSchema, at least one, not {schemas!r}."
        yield Fault(text, "A tuple of one needs a comma.")
        return
    names = [schema.name for schema in schemas]
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield Fault(f"two actions are called {name!r}.", "A reply could not say which of them is meant.")
    for schema in schemas:
        if not schema.description.strip():
            yield Fault(
                f"action {schema.name!r} has no description.", "All that a model knows of an action is its schema."
            )
        elif schema.description.rstrip().endswith("."):
            yield Fault(
                f"the description of action {schema.name!r} ends with a full stop: {schema.description!r}.",
                "The templates write one.",
            )
        for p in schema.parameters:
            if p.low == p.high:
                yield Fault(
                    f"parameter {p.name!r} of action {schema.name!r} can only be {p.low:g}.",
                    "A range of one value is no parameter: leave it out, or widen it.",
                )
        if schema.objects and not world.env.objects:
            yield Fault(
                f"action {schema.name!r} takes {', '.join(schema.objects)}, and there are no objects.",
                "Env.objects lists the names that actions may take.",
            )


def objects_have_different_names(world: World) -> Iterator[Fault]:
    """The objects are a tuple of different texts that are not empty."""
    objects = world.env.objects
    if not isinstance(objects, tuple) or not all(isinstance(name, str) and name.strip() for name in objects):
        yield Fault(f"objects must be a tuple of names, not {objects!r}.", "A tuple of one needs a comma: ('cup',).")
        return
    for name in sorted({name for name in objects if objects.count(name) > 1}):
        yield Fault(f"two objects are called {name!r}.", "A reply could not say which of them is meant.")


def actions_read_back(world: World) -> Iterator[Fault]:
    """What str() writes of an action is read back as that action, to the last bit."""
    rng = generator("actions", world.seed)
    draw = Drawing(world.env, {}, rng)
    for action in chain(draw.some(world.start, 1), islice(draw.each(set()), READ)):
        reply = dumps({"Reasoning": "", "Full Plan": [str(action)]})
        read = parse_reply(reply, world.env.schemas, world.env.objects)
        item = read.actions[0] if isinstance(read, Proposal) and read.actions else read
        if item != action:
            why = item.failure.detail if isinstance(item, Rejected) else f"it reads as {item}"
            yield Fault(
                f"{action} is not read as it is written: {why}.",
                "Names of objects and parameters must be plain words, and differ by more than case and signs.",
            )


FORM_RULES = (schemas_tell_what_there_is_to_do, objects_have_different_names)
"""Looked at before any action is drawn."""
RULES = (actions_read_back,)


def usable(world: World) -> bool:
    """Whether actions can be drawn."""
    try:
        schemas, objects = world.env.schemas, world.env.objects
    except (Exception, SystemExit):  # a rule tells of it
        return False
    return (
        isinstance(schemas, tuple | list)
        and isinstance(objects, tuple | list)
        and all(isinstance(schema, ActionSchema) for schema in schemas)
        and all(isinstance(name, str) for name in objects)
    )
