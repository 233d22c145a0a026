"""Every sentence of the parser: what the model reads about its reply, and what the record says was mended."""

# ruff: noqa: D103  # each function is the sentence that its name announces

from __future__ import annotations

from collections.abc import Sequence

from llm3.parsing.values import Value, written
from llm3.types import ActionSchema, Parameter, Sketch
from llm3.wording import counted

# ---- what was mended ---------------------------------------------------------------------------------------------

SINGLE_QUOTES = "read text in single quotes"
TYPOGRAPHIC_QUOTES = "read text in typographic quotes"
LINE_BREAK = "read text with a line break in it"
NO_QUOTES = "read text without quotes"
PYTHON_LITERAL = "read a Python literal (True, False or None)"
COMMENT = "ignored a comment"
TRAILING_COMMA = "ignored a trailing comma"
UNESCAPED_QUOTES = "took away the quotes around actions, as there are quotes inside"
BARE_LIST = 'took a list of actions that is not in the reply\'s "Full Plan"'

# ---- the reply as a whole ----------------------------------------------------------------------------------------

_FORM = """{"Reasoning": "...", "Full Plan": ["action(['object'], {'parameter': number})", ...]}"""
_WRITE = f"write one JSON object of the form {_FORM}"
EMPTY = f"the reply is empty: {_WRITE}"
NO_PLAN = f"no complete plan can be read from the reply: {_WRITE}"
CUT_OFF = f"the reply was cut off at the length limit before its plan was complete: reason more briefly, and {_WRITE}"
PLAN_IS_NO_LIST = f"the plan is no list: {_WRITE}"


def too_long(length: int, limit: int) -> str:
    return f"the reply has {length} characters: at most {limit} are read"


def too_many_actions(count: int, limit: int) -> str:
    return f"the plan has {count} actions: at most {limit} are allowed"


# ---- one action --------------------------------------------------------------------------------------------------


def unreadable_item(text: str, schemas: Sequence[ActionSchema]) -> str:
    forms = " or ".join(_form(schema) for schema in schemas)
    return f"cannot read {_quoted(text)} as one action: write {forms}"


def unknown_action(name: str, known: Sequence[str]) -> str:
    return f"unknown action {_quoted(name)}: the actions are {', '.join(known)}"


def wrong_number_of_objects(schema: ActionSchema, given: Sequence[Value]) -> str:
    wanted = (
        f"{counted(len(schema.objects), 'object')} ({', '.join(schema.objects)})" if schema.objects else "no objects"
    )
    shown = f" ({cut(', '.join(written(value) for value in given))})" if given else ""
    return f"{schema.name} takes {wanted}, not {len(given)}{shown}"


def unknown_object(value: Value, known: Sequence[str]) -> str:
    return f"unknown object {_quoted(written(value))}: the objects are {', '.join(known)}"


def missing_parameter(schema: ActionSchema, parameter: Parameter) -> str:
    return f"{schema.name} lacks {parameter.name}: give a number {_range(parameter)}"


def extra_parameter(schema: ActionSchema, name: str) -> str:
    known = ", ".join(parameter.name for parameter in schema.parameters)
    return f"{schema.name} has no parameter {_quoted(name)}: {f'it takes {known}' if known else 'it takes none'}"


def given_twice(schema: ActionSchema, parameter: Parameter) -> str:
    return f"{schema.name} has {parameter.name} more than once: give one number {_range(parameter)}"


def not_a_number(parameter: Parameter, value: Value) -> str:
    shown = _quoted(value) if isinstance(value, str) else cut(written(value))
    return f"{parameter.name} = {shown} is no plain number: it must be one {_range(parameter)}"


def out_of_range(parameter: Parameter, value: Value) -> str:
    return f"{parameter.name} = {cut(written(value).strip())} is out of range: it must be {_range(parameter)}"


# ---- a given sequence --------------------------------------------------------------------------------------------

END_OF_PLAN = "(end of the plan)"
_GIVEN = "the action sequence is given, choose the parameters only"


def departs(place: int, wanted: Sketch, given: Sketch) -> str:
    return f"action {place} must be {wanted}, not {given}: {_GIVEN}"


def too_short(place: int, wanted: Sketch) -> str:
    return f"action {place} is missing, it must be {wanted}: {_GIVEN}"


def one_too_many(place: int, text: str, length: int) -> str:
    return f"action {place}, {cut(text)}, is one too many, the plan must have {length}: {_GIVEN}"


# ---- how things are shown ----------------------------------------------------------------------------------------

_SHOWN = 120
"""How many characters of the model's own text it is shown again."""
_FAULTS = 3
"""How many things that are wrong with one action are named."""


def cut(text: str) -> str:
    """The text in a readable length, on one line."""
    short = text if len(text) <= _SHOWN else text[: _SHOWN - 1] + "…"
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in short)


def joined(faults: Sequence[str]) -> str:
    """Several faults as one sentence; the first few, if there are many."""
    named = "; ".join(faults[:_FAULTS])
    return f"{named}; and {len(faults) - _FAULTS} more" if len(faults) > _FAULTS else named


def _quoted(text: str) -> str:
    return f"'{cut(text)}'"


def _range(parameter: Parameter) -> str:
    text = f"from {_plain(parameter.low)} to {_plain(parameter.high)}"
    return f"{text} {parameter.unit}" if parameter.unit else text


def _plain(number: float) -> str:
    return repr(float(number)).removesuffix(".0")


def _form(schema: ActionSchema) -> str:
    params = ", ".join(f"'{parameter.name}': number" for parameter in schema.parameters)
    return f"{schema.name}({list(schema.objects)!r}, {{{params}}})"
