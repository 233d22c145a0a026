"""Holds a draft against the schemas. Nothing is clamped, rounded or guessed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from llm3.parsing import sentences
from llm3.parsing.drafts import Draft
from llm3.parsing.values import Bare, Value, number, written
from llm3.types import Action, ActionSchema


def faults(drafted: Draft, schemas: Mapping[str, ActionSchema], objects: Sequence[str]) -> Action | list[str]:
    """The action, or all that is wrong with it as sentences for the model.

    A bound belongs to its range, and comparison is exact.
    """
    schema = schemas.get(drafted.name)
    if schema is None:
        return [sentences.unknown_action(drafted.name, tuple(schemas))]
    problems = [*_object_faults(drafted, schema, objects), *_parameter_faults(drafted, schema)]
    if problems:
        return problems
    values = {name: number(value) for name, value in drafted.params}
    params = {p.name: value for p in schema.parameters if (value := values[p.name]) is not None}
    return Action(schema.name, tuple(written(value) for value in drafted.objects), params)


def _object_faults(drafted: Draft, schema: ActionSchema, objects: Sequence[str]) -> Iterator[str]:
    if len(drafted.objects) != len(schema.objects):
        yield sentences.wrong_number_of_objects(schema, drafted.objects)
        return
    for value in dict.fromkeys(drafted.objects):
        if not isinstance(value, str | Bare) or written(value) not in objects:
            yield sentences.unknown_object(value, objects)


def _parameter_faults(drafted: Draft, schema: ActionSchema) -> Iterator[str]:
    given: dict[str, list[Value]] = {}
    for name, value in drafted.params:
        given.setdefault(name, []).append(value)
    for parameter in schema.parameters:
        values = given.pop(parameter.name, [])
        if not values:
            yield sentences.missing_parameter(schema, parameter)
        elif len(values) > 1:
            yield sentences.given_twice(schema, parameter)
        elif (figure := number(values[0])) is None:
            yield sentences.not_a_number(parameter, values[0])
        elif not parameter.low <= figure <= parameter.high:
            yield sentences.out_of_range(parameter, values[0])
    for name in given:
        yield sentences.extra_parameter(schema, name)
