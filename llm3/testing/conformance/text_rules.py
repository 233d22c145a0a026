"""Rules for what a model reads: the task, the state, the prompt."""

from __future__ import annotations

from collections.abc import Iterator

from llm3.prompts import value
from llm3.solve import context_of
from llm3.testing.conformance.description_rules import described
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.values import programmer_talk
from llm3.testing.conformance.world import World
from llm3.types import Entity
from llm3.types.state import LENGTH_DECIMALS

PLAIN = "Round numbers and write them with an f-string: float(x), not numpy's own form."


def the_task_is_told(world: World) -> Iterator[Fault]:
    """The task is prose."""
    task = world.env.task
    if not isinstance(task, str) or not task.strip():
        yield Fault(f"task must be a text, not {task!r}.", "It tells the world, the robot and the goal, as prose.")
    elif talk := programmer_talk(task):
        yield Fault(f"the task holds {talk!r}.", PLAIN)


def the_state_is_described(world: World) -> Iterator[Fault]:
    """The answer of describe is entities of different names, with numbers that are rounded."""
    for state in [world.start, *(trial.transition.state for trial in world.applied if trial.transition)]:
        entities = world.env.describe(state)
        if not isinstance(entities, tuple) or not all(isinstance(entity, Entity) for entity in entities):
            yield Fault(f"describe must answer a tuple of Entity, not {entities!r}.", "A tuple of one needs a comma.")
            return
        if not entities:
            yield Fault("describe answers nothing.", "What is not described, no model knows.")
        names = [entity.name for entity in entities]
        for name in sorted({name for name in names if names.count(name) > 1}):
            yield Fault(f"describe names two things {name!r}.", "Actions and feedback refer to things by their names.")
        for entity in entities:
            for name, shown in entity.properties.items():
                text = value(shown)
                if talk := programmer_talk(text):
                    yield Fault(f"{name} of {entity.name} holds {talk!r}: {text}.", PLAIN)
                numbers = shown if isinstance(shown, tuple) else (shown,)
                if any(isinstance(n, float) and abs(n - round(n, LENGTH_DECIMALS)) > 1e-12 for n in numbers):
                    yield Fault(
                        f"{name} of {entity.name} is written with all its digits: {text}.",
                        f"Round what describe answers to {LENGTH_DECIMALS} decimals or fewer.",
                    )


def every_object_is_told_of(world: World) -> Iterator[Fault]:
    """Each object that an action may take is named in the task or in the description of the initial state."""
    told = world.env.task + " ".join(described(world.env, world.start))
    for name in world.env.objects:
        if name not in told:
            yield Fault(
                f"{name!r} is an object, and neither the task nor the initial state tells of it.",
                "describe leaves it out, or calls it by another name than objects does.",
            )


def every_prompt_renders(world: World) -> Iterator[Fault]:
    """Each registered strategy writes its prompt for this world, with nothing in it that is not for a model."""
    for name, prompt in world.helpers.prompts.items():
        skeleton = world.skeleton if prompt.strategy.fixed_sequence else ()
        if prompt.strategy.fixed_sequence and not skeleton:
            continue
        messages = prompt.render(context_of(world.env, world.start, (), skeleton))
        for message in messages:
            if talk := programmer_talk(message.content):
                yield Fault(f"the prompt of strategy {name!r} holds {talk!r}.", PLAIN)


RULES = (
    the_task_is_told,
    the_state_is_described,
    every_object_is_told_of,
    every_prompt_renders,
)
