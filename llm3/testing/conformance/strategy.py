"""The check of a prompt strategy."""

from __future__ import annotations

import re
from collections.abc import Iterator

from llm3.interfaces import Strategy
from llm3.prompts import Prompt, value
from llm3.testing.conformance.attempts import SKELETON, context, trace
from llm3.testing.conformance.complaint import Complaint, Report
from llm3.testing.conformance.inspection import Fault, Inspection
from llm3.testing.conformance.values import programmer_talk
from llm3.types import Context, Message

_HOLE = re.compile(r"\{\{|\}\}|\{%|%\}|\bNone\b|\bUndefined\b")
INSTEAD = "a template writes a prompt for every context"
ANSWER_KEY = "Full Plan"
"""How the asked-for reply calls the plan."""


class Asking:
    """A strategy's template at work."""

    def __init__(self, strategy: Strategy) -> None:
        self.strategy, self.prompt = strategy, Prompt(strategy)
        skeleton = SKELETON if strategy.fixed_sequence else ()
        self.first = context(skeleton=skeleton)
        self.later = context(trace(), skeleton)
        self.bare = context(skeleton=skeleton[:1], objects=False)

    def messages(self, of: Context) -> tuple[Message, ...]:
        """What a model is sent."""
        return self.prompt.render(of)

    def text(self, of: Context) -> str:
        """The messages as one text."""
        return "\n\n".join(message.content for message in self.messages(of))


def prompts_are_written_for_every_context(asking: Asking) -> Iterator[Fault]:
    """The template renders at first and later, with objects and without, and the same context gives the same prompt."""
    for of in (asking.first, asking.later, asking.bare):
        messages = asking.messages(of)
        if messages != asking.messages(of):
            yield Fault("the same context is written in two ways.", "A template must not draw or count.")
        for number, message in enumerate(messages, start=1):
            if not message.content.strip():
                yield Fault(f"message {number}, of the {message.role}, is empty.", "A condition left all of it out.")
        if messages[-1].role != "user":
            yield Fault(
                f"the last message is the {messages[-1].role}'s.", "A model answers to the user: let one end with it."
            )


def prompts_have_no_holes(asking: Asking) -> Iterator[Fault]:
    """Nothing of Jinja or Python is left in a prompt."""
    for of in (asking.first, asking.later, asking.bare):
        text = asking.text(of)
        hole = _HOLE.search(text)
        talk = programmer_talk(text) or (hole.group() if hole else "")
        if talk:
            at = text.index(talk)
            yield Fault(
                f"the prompt holds {talk!r}: …{text[max(0, at - 30) : at + 40]}….",
                "Write {{ name }} outside of raw blocks, and properties and actions by the filters value and usage.",
            )


def prompts_tell_the_task_and_the_state(asking: Asking) -> Iterator[Fault]:
    """The task, and each entity with its properties, stand in the prompt."""
    text = asking.text(asking.first)
    if asking.first.task not in text:
        yield Fault(
            "the prompt does not tell the task.", "Include llm3_templates/partials/task.j2, or write {{ task }}."
        )
    for entity in asking.first.state:
        for part in (entity.name, *entity.properties, *map(value, entity.properties.values())):
            if part not in text:
                yield Fault(
                    f"the prompt does not tell {part!r} of {entity.name}.",
                    "Write every entity of {{ state }} with all its properties; partials/task.j2 does.",
                )


def prompts_tell_the_actions(asking: Asking) -> Iterator[Fault]:
    """Each action with its description and its parameters' ranges, and each object, stand in the prompt."""
    text = asking.text(asking.first)
    cause = "Write every schema of {{ actions }} with its ranges, and {{ objects }}; partials/task.j2 does."
    for schema in asking.first.actions:
        ranges = [str(bound) for p in schema.parameters for bound in (p.low, p.high)]
        for part in (f"{schema.name}(", schema.description, *(p.name for p in schema.parameters), *ranges):
            if part not in text:
                yield Fault(f"the prompt does not tell {part!r} of action {schema.name!r}.", cause)
    for name in asking.first.objects:
        if name not in text:
            yield Fault(f"the prompt does not name the object {name!r}.", cause)


def prompts_tell_how_to_answer(asking: Asking) -> Iterator[Fault]:
    """The form of the answer stands in the prompt."""
    if ANSWER_KEY not in asking.text(asking.first):
        yield Fault(
            f"the prompt does not say that the plan stands under {ANSWER_KEY!r}.",
            "Include llm3_templates/partials/format.j2: the parser reads what it asks for.",
        )


def prompts_tell_of_earlier_attempts(asking: Asking) -> Iterator[Fault]:
    """Every remark and every summary of the trace stands in the prompt."""
    text = asking.text(asking.later)
    for feedback in asking.later.trace:
        parts = [feedback.summary, *(p for r in feedback.remarks for p in (r.action, r.verdict, r.text))]
        for part in parts:
            if part not in text:
                yield Fault(
                    f"the prompt does not tell {part!r} of attempt {feedback.attempt}.",
                    "Write every feedback of {{ trace }}, its remarks and its summary; partials/trace.j2 does.",
                )


def a_given_sequence_is_shown(asking: Asking) -> Iterator[Fault]:
    """A strategy with a fixed sequence shows it."""
    text = asking.text(asking.first)
    for sketch in asking.first.skeleton:
        if str(sketch) not in text:
            yield Fault(
                f"the prompt does not show {sketch} of the given sequence.",
                "With fixed_sequence=True the template writes every sketch of {{ skeleton }}.",
            )


RULES = (
    prompts_are_written_for_every_context,
    prompts_have_no_holes,
    prompts_tell_the_task_and_the_state,
    prompts_tell_the_actions,
    prompts_tell_how_to_answer,
    prompts_tell_of_earlier_attempts,
    a_given_sequence_is_shown,
)


def check_strategy(strategy: Strategy) -> tuple[Complaint, ...]:
    """Look for faults in a prompt strategy, on contexts with and without earlier attempts."""
    return examine_strategy(strategy).complaints


def examine_strategy(strategy: Strategy) -> Report:
    """Like :func:`check_strategy`, with what was looked at."""
    inspection = Inspection(INSTEAD)
    try:
        asking = Asking(strategy)
    except Exception as error:
        inspection.raised(error)
        return inspection.report
    inspection.apply(RULES, asking)
    return inspection.report
