"""The JSON schema of a reply, for servers that can hold a model to one.

Whatever a server promises, the reply is read and checked like any other.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from llm3.types import ActionSchema, FrozenDict, Sketch

NUMBER = "-?[0-9]+(\\.[0-9]+)?"
"""A plain decimal number, as a regular expression. Ranges are left to the parser, which has sentences for them."""


def reply_schema(
    schemas: Sequence[ActionSchema], objects: Sequence[str], skeleton: Sequence[Sketch] = ()
) -> Mapping[str, Any]:
    """The JSON schema of the asked-for form, in which every action is a text of a regular expression.

    Args:
        schemas: The valid actions.
        objects: The names that actions may take.
        skeleton: The given action sequence, where the model chooses the parameters only.
    """
    by_name = {schema.name: schema for schema in schemas}
    if skeleton:
        sketches = dict.fromkeys((sketch.name, sketch.objects) for sketch in skeleton)
        forms = [_form(by_name[name], [[thing] for thing in things]) for name, things in sketches if name in by_name]
    else:
        forms = [_form(schema, [objects] * len(schema.objects)) for schema in schemas]
    items = {"type": "string", "pattern": f"^({'|'.join(forms)})$"} if forms else {"type": "string"}
    return FrozenDict(
        {
            "type": "object",
            "properties": {"Reasoning": {"type": "string"}, "Full Plan": {"type": "array", "items": items}},
            "required": ["Reasoning", "Full Plan"],
            "additionalProperties": False,
        }
    )


def _form(schema: ActionSchema, choices: Sequence[Iterable[str]]) -> str:
    """The regular expression of an action, each of whose objects is one of the choices in its place."""
    objects = ", ".join(_one_of(names) for names in choices)
    parameters = ", ".join(f"{_literal(repr(parameter.name))}: {NUMBER}" for parameter in schema.parameters)
    return f"{schema.name}\\(\\[{objects}\\], \\{{{parameters}\\}}\\)"


def _one_of(names: Iterable[str]) -> str:
    return f"({'|'.join(_literal(repr(name)) for name in names)})"


def _literal(text: str) -> str:
    """A regular expression of this text. Only what must be escaped is: JSON schema's dialect refuses the rest."""
    return "".join(f"\\{c}" if c in "\\^$.*+?()[]{}|/" else c for c in text)
