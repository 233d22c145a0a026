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

_HOLE = re.compile(r"\{\{|\{%|\bNone\b(?! (?:of|other|at all)\b)|\bUndefined\b")
"""An example of nested JSON may end with two brackets, and none begins with two."""
INSTEAD = "a template writes a prompt for every context"
_BETWEEN = r"\s*(?:cm|rad)?\s*(?:to|and|,|\.\.+|…|–|-|/|:|≤|<=)?\s*"
"""What may stand between the two ends of a range."""
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

    @property
    def prompts(self) -> tuple[tuple[str, Context, str], ...]:
        """The first prompt and a later one: what each is called, what it is of, and its text in single blanks."""
        named = (("the prompt", self.first), ("the later prompt", self.later))
        return tuple((name, of, _plain(self.text(of))) for name, of in named)

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
    """The task, and each entity with its properties, stand in each prompt."""
    for prompt, of, text in asking.prompts:
        if of.task not in text:
            yield Fault(
                f"{prompt} does not tell the task.", "Include llm3_templates/partials/task.j2, or write {{ task }}."
            )
        for entity in of.state:
            for part in (entity.name, *entity.properties, *map(value, entity.properties.values())):
                if part not in text:
                    yield Fault(
                        f"{prompt} does not tell {part!r} of {entity.name}.",
                        "Write every entity of {{ state }} with all its properties; partials/task.j2 does.",
                    )


def prompts_tell_the_actions(asking: Asking) -> Iterator[Fault]:
    """Each action with what it takes, its description, its ranges and units, and each object, stand in each prompt."""
    cause = "Write every schema of {{ actions }} with its ranges and units, and {{ objects }}; partials/task.j2 does."
    for prompt, of, text in asking.prompts:
        for schema in of.actions:
            names = (*schema.objects, *(word for p in schema.parameters for word in (p.name, p.unit)))
            numbers = [str(bound) for p in schema.parameters for bound in (p.low, p.high)]
            missing = [part for part in (f"{schema.name}(", schema.description) if part not in text]
            for part in [*missing, *(word for word in (*names, *numbers) if not _word(word).search(text))]:
                yield Fault(f"{prompt} does not tell {part!r} of action {schema.name!r}.", cause)
            for p in schema.parameters:
                if re.search(rf"{_word(str(p.high)).pattern}{_BETWEEN}{_word(str(p.low)).pattern}", text):
                    yield Fault(
                        f"{prompt} tells the range of {p.name!r} of action {schema.name!r} from its end.",
                        "A parameter goes from p.low to p.high.",
                    )
        for name in of.objects:
            if name not in text:
                yield Fault(f"{prompt} does not name the object {name!r}.", cause)


def prompts_tell_how_to_answer(asking: Asking) -> Iterator[Fault]:
    """The form of the answer stands in each prompt."""
    for prompt, _, text in asking.prompts:
        if ANSWER_KEY not in text:
            yield Fault(
                f"{prompt} does not say that the plan stands under {ANSWER_KEY!r}.",
                "Include llm3_templates/partials/format.j2: the parser reads what it asks for.",
            )


def prompts_tell_of_earlier_attempts(asking: Asking) -> Iterator[Fault]:
    """Every remark and every summary of the trace stands in the prompt."""
    for _, of, text in asking.prompts:
        for feedback in of.trace:
            parts = [feedback.summary, *(p for r in feedback.remarks for p in (r.action, r.verdict, r.text))]
            for part in parts:
                if part not in text:
                    yield Fault(
                        f"the prompt does not tell {part!r} of attempt {feedback.attempt}.",
                        "Write every feedback of {{ trace }}, its remarks and its summary; partials/trace.j2 does.",
                    )


def a_given_sequence_is_shown(asking: Asking) -> Iterator[Fault]:
    """A strategy with a fixed sequence shows it in each prompt."""
    for prompt, of, text in asking.prompts:
        for sketch in of.skeleton:
            if str(sketch) not in text:
                yield Fault(
                    f"{prompt} does not show {sketch} of the given sequence.",
                    "With fixed_sequence=True the template writes every sketch of {{ skeleton }}.",
                )


def _plain(text: str) -> str:
    """The text without its line breaks, which are the template's business."""
    return " ".join(text.split())


def _word(part: str) -> re.Pattern[str]:
    """Finds a word or a number, and not in the middle of another one; a unit may follow a number at once."""
    number = part[-1].isdigit()
    before, after = (r"(?<![\d.])", r"(?!\d)") if number else (r"(?<![^\W\d])", r"(?![^\W_])")
    return re.compile(f"{before}{re.escape(part)}{after}")


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
