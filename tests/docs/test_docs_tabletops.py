"""The page on domains on a table: its domain works, and its names are those of the library."""

from __future__ import annotations

import ast
import importlib
import inspect
from pathlib import Path

import pytest
from docs_pages import ROOT, blocks, names, page, table

PAGE = page("tabletops")
FOLDER = ROOT / "plugins" / "llm3_bullet" / "tabletop"
INNER = {"grasps", "overlaps", "surprises", "start_check"}
"""Modules that a domain has no need of."""


def public_names(file: Path) -> set[str]:
    """Functions, classes and constants at the top of a module."""
    found = set()
    for node in ast.parse(file.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            found.add(node.name)
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            found |= {target.id for target in targets if isinstance(target, ast.Name)}
    return {name for name in found if not name.startswith("_")}


def test_every_name_of_the_table_is_in_its_module():
    module, seen = "", set()
    for row in table(PAGE, "What there is").rows:
        module = row[0].strip("`") or module
        seen.add(module)
        assert set(names(row[1])) <= public_names(FOLDER / f"{module}.py"), module
    assert seen | INNER == {file.stem for file in FOLDER.glob("*.py")} - {"__init__"}


@pytest.mark.pybullet
def test_every_method_of_a_tabletop_is_told():
    from llm3_bullet.tabletop.tabletop import Tabletop

    methods = {n: f for n, f in inspect.getmembers(Tabletop, inspect.isfunction) if not n.startswith("_")}
    told = [name.rstrip(")").split("(") for name in table(PAGE, "Tabletop").names]
    assert {name for name, _ in told} == set(methods)
    for name, arguments in told:
        assert ["self", *arguments.split(", ")] == list(inspect.signature(methods[name]).parameters)


@pytest.mark.pybullet
def test_the_second_look_offers_what_the_page_says():
    from llm3_bullet import verification

    assert set(table(PAGE, "The second look").names) == set(verification.__all__)


@pytest.mark.pybullet
def test_the_domain_of_the_page_runs(tmp_path, monkeypatch):
    from llm3 import Registry, RunConfig, assemble

    (block,) = blocks(PAGE, "python")
    (tmp_path / "sides_of_the_manual.py").write_text(block.text, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    registry = Registry.discover()
    registry.register(importlib.import_module("sides_of_the_manual"), "sides (the manual)")
    config = RunConfig("sides", llm="random", strategy="sample-params", timing="none")
    with assemble(registry, config) as run:
        assert run.solve().solved
