"""Fields of an experiment that are set on the command line, in place of what its file says."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from typing import Any

from llm3.errors import InputError, UnknownName, UsageError
from llm3.experiments.toml_file import parse_toml

LISTS = ("methods", "problems")
"""Tables of which there are several, told apart by their names."""


def overridden(written: Mapping[str, Any], assignments: Sequence[tuple[str, str]]) -> dict[str, Any]:
    """What a TOML file says, with some fields set anew.

    Args:
        written: The file's content.
        assignments: Fields and values, such as ``("run.max_llm_calls", "5")`` or
            ``("methods.random.trace_size", "3")``. A value is read as TOML, and as plain text where it is none.

    Raises:
        UsageError: There is no such method or problem, or a field is asked of what has none.
    """
    changed: dict[str, Any] = deepcopy(dict(written))
    for field, text in assignments:
        table, name = _table(changed, field)
        table[name] = _value(text)
    return changed


def _table(written: dict[str, Any], field: str) -> tuple[dict[str, Any], str]:
    """The table that holds a field, and the field's name in it."""
    first, _, rest = field.partition(".")
    table: Any = written
    if first in LISTS and rest:
        entries = {_name(entry): entry for entry in written.get(first, ()) if isinstance(entry, dict)}
        named = [name for name in entries if rest.startswith(f"{name}.")]
        if not named:
            raise UnknownName(first.removesuffix("s"), rest.rpartition(".")[0] or rest, entries)
        name = max(named, key=len)  # one name may begin with another
        table, field = entries[name], rest[len(name) + 1 :]
    *path, last = field.split(".")
    if not last or "" in path:
        raise UsageError(f"--set {field!r}: a field is a name, or several with a dot between them.")
    for part in path:
        table = table.setdefault(part, {})
        if not isinstance(table, dict):
            raise UsageError(f"--set {field!r}: {part!r} is a value and has no fields.")
    return table, last


def _name(entry: Mapping[str, Any]) -> str:
    """A list of settings has the name of their domain."""
    setting = entry.get("setting", "")
    return str(entry.get("name", entry.get("domain", "") if isinstance(setting, list) else setting))


def _value(text: str) -> Any:
    try:
        return parse_toml(f"value = {text}", "")["value"]
    except (InputError, KeyError):
        return text
