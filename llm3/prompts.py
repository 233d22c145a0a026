"""From a Context and a strategy's template to the messages that a model is sent."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, get_args

import jinja2

from llm3.errors import PluginError
from llm3.interfaces import Strategy
from llm3.types import ActionSchema, Context, Message
from llm3.types.dialogue import Property, Role

PARTIALS = "llm3_templates"
"""The package whose files every template may include."""


class Prompt:
    """A strategy's template, ready to render.

    A template writes its messages with ``{% call message("system") %}…{% endcall %}``. It sees the fields of
    :class:`llm3.types.Context` and two filters, `usage` (how an action is written) and `value` (a property of an
    entity). An undefined name is an error, never an empty string.
    """

    def __init__(self, strategy: Strategy) -> None:
        """Load the template.

        Raises:
            PluginError: The package or the template is not there, or the template has a syntax error.
        """
        self.strategy = strategy
        self._name = f"{strategy.package}/{strategy.template}"
        try:
            packages = {p: jinja2.PackageLoader(p, "") for p in {strategy.package, PARTIALS}}
            environment = jinja2.Environment(
                loader=jinja2.PrefixLoader(packages),
                undefined=jinja2.StrictUndefined,
                autoescape=False,  # noqa: S701  # plain text for a model, not HTML
                trim_blocks=True,
                lstrip_blocks=True,
            )
            environment.filters.update(usage=usage, value=value)
            self._template = environment.get_template(self._name)
        except (ImportError, ValueError, jinja2.TemplateError) as error:
            raise PluginError(f"prompt template {self._name!r} cannot be loaded: {_located(error)}") from error

    def render(self, context: Context) -> tuple[Message, ...]:
        """The messages for this context.

        Raises:
            PluginError: The template uses a name that there is not, fails otherwise, writes no message, or writes
                text outside of its messages, which no model would see.
        """
        messages: list[Message] = []

        def message(role: Role, caller: Callable[[], str]) -> str:
            if role not in get_args(Role):
                raise jinja2.TemplateRuntimeError(f"unknown role {role!r}; roles are {', '.join(get_args(Role))}")
            messages.append(Message(role, caller().strip()))
            return ""

        fields: dict[str, Any] = {name: getattr(context, name) for name in context.__dataclass_fields__}
        try:
            outside = self._template.render(**fields, message=message).strip()
        except Exception as error:  # a template may raise whatever its expressions raise
            raise PluginError(f"prompt template {self._name!r} cannot be rendered: {_located(error)}") from error
        if outside:
            raise PluginError(f"prompt template {self._name!r} writes text outside of its messages: {outside[:60]!r}.")
        if not messages:
            raise PluginError(f"prompt template {self._name!r} writes no message: use {{% call message(role) %}}.")
        return tuple(messages)


def _located(error: Exception) -> str:
    place = f" (line {error.lineno})" if isinstance(error, jinja2.TemplateSyntaxError) else ""
    return f"{error}{place}"


def usage(schema: ActionSchema) -> str:
    """How an action is written, with placeholders: ``place(['<box>'], {'x': <number>, 'y': <number>})``."""
    objects = ", ".join(f"'<{role}>'" for role in schema.objects)
    params = ", ".join(f"'{p.name}': <number>" for p in schema.parameters)
    return f"{schema.name}([{objects}], {{{params}}})"


def value(property_: Property) -> str:
    """A property as the model reads it: numbers to the last digit, vectors in round brackets."""
    if isinstance(property_, (tuple, list)):
        return "(" + ", ".join(value(p) for p in property_) + ")"
    return property_ if isinstance(property_, str) else repr(property_)
