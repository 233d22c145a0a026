from __future__ import annotations

import dataclasses
import importlib
import inspect
import pkgutil
import re
import typing

import pytest
from docs_pages import ROOT, names, page, table, tables

import llm3
from llm3.registry import HOOKS

PUBLIC = ("llm3", "llm3.types", "llm3.interfaces", "llm3.records", "llm3.report", "llm3.testing")


def has_docstring(thing: object) -> bool:
    """Whether it is a class or a function; what is left is aliases, some of which Python 3.10 takes for classes."""
    return (inspect.isclass(thing) or inspect.isfunction(thing)) and typing.get_origin(thing) is None


def things() -> list[tuple[str, object]]:
    found = []
    for name in PUBLIC:
        module = importlib.import_module(name)
        found += [(f"{name}.{n}", getattr(module, n)) for n in module.__all__]
    return found


@pytest.mark.parametrize(("name", "thing"), [(n, t) for n, t in things() if has_docstring(t)])
def test_every_public_class_and_function_has_a_docstring_of_its_own(name, thing):
    written = thing.__dict__.get("__doc__") if inspect.isclass(thing) else thing.__doc__
    assert written
    if dataclasses.is_dataclass(thing):  # which makes one up where there is none
        assert not written.startswith(f"{thing.__name__}(")


@pytest.mark.parametrize("hook", HOOKS.values())
def test_every_hook_has_a_section_and_a_row(hook):
    text = page("hooks")
    assert f"\n## {hook}\n" in text
    assert hook in table(text, "What a plugin is").names


def test_every_alias_is_written_into_the_reference():
    aliases = [n for n, t in things() if not has_docstring(t)]
    assert aliases
    for name in aliases:
        assert f".. py:data:: {name.rpartition('.')[2]}\n" in page("api"), name


def test_the_reference_names_what_llm3_offers_from_elsewhere():
    module = importlib.import_module("llm3")
    for name in module.__all__:
        assert name in page("api"), name


def test_everybody_names_the_same_public_modules():
    public = {line.removeprefix("## ") for line in page("api").splitlines() if line.startswith("## ")}
    promised = page("hooks").partition("These modules are public")[2].partition("Domains on PyBullet")[0]
    assert set(names(promised)) - {"api"} == public
    contributing = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    asked = contributing.partition("import the public\nnames only: ")[2].partition("import-linter")[0]
    assert set(names(asked)) == public
    project = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    commented = project.partition("# Public: ")[2].partition(".\ntype")[0]
    assert set(re.split(r"[,\s#]+", commented)) == public
    contract = project.partition("protected_modules = [")[2].partition("]")[0]
    protected = set(re.findall(r'"([^"]+)"', contract))
    own = {f"llm3.{module.name}" for module in pkgutil.iter_modules(llm3.__path__)} - {"llm3.__main__"}
    assert {name for name in protected if not name.endswith(".*")} == own - public
    assert {name.removesuffix(".*") for name in protected if name.endswith(".*")} <= public


def test_the_front_page_and_the_command_line_name_what_ships():
    from importlib import metadata

    from llm3 import Registry

    own = [e for e in metadata.entry_points(group="llm3") if e.dist and e.dist.name == "llm3"]
    registry = Registry.discover(own)
    assert not registry.broken
    flags = {"--domain": "domain", "--strategy": "strategy", "--feedback": "feedback", "--planner": "planner"}
    flags |= {"--timing": "timer", "--llm": "backend"}
    listed: dict[str, set[str]] = {}
    flag = ""
    for row in next(t for t in tables(page("command-line")) if t.heading == "Names").rows:
        flag = row[0].strip("`") or flag
        listed.setdefault(flag, set()).add(row[1].strip("`"))
    assert listed == {flag: set(registry.names(kind)) for flag, kind in flags.items()}
    for kind in HOOKS:
        for name in registry.names(kind):
            assert f"`{name}`" in page("index")
