"""Every tutorial begins with a package that `llm3 new` writes: its commands do what the page says."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest
from command_line import install_package
from docs_pages import DOCS, blocks, page, table

from llm3.cli.main import main
from llm3.cli.text import printable
from llm3.scaffold import KINDS, Name, render

TUTORIALS = {
    "domain": "first-domain",
    "planner": "own-planner",
    "feedback": "own-feedback",
    "backend": "own-model",
    "strategy": "own-strategy",
}


def commands(kind: str) -> tuple[str, ...]:
    """The block of a tutorial that begins with `llm3 new`."""
    (block,) = [b for b in blocks(page(TUTORIALS[kind]), "console") if b.text.startswith("$ llm3 new ")]
    return tuple(re.findall(r"^\$ (.*)$", block.text, re.MULTILINE))


@pytest.fixture
def forgotten_afterwards(corridor: Path):
    """What is imported from the installed packages is forgotten."""
    before = set(sys.modules)
    yield
    for name in set(sys.modules) - before:
        if name.startswith("llm3_my_"):
            del sys.modules[name]


@pytest.mark.parametrize("kind", KINDS)
def test_the_first_commands_work_and_are_those_that_the_program_prints(corridor, forgotten_afterwards, capsys, kind):
    new, install, *others, tests = commands(kind)
    assert main(new.split()[1:]) == 0
    printed = [printable(line) for line in capsys.readouterr().out.splitlines()[1:]]
    assert printed == [install, *others, tests]
    folder = corridor / install.split()[-1]
    install_package(corridor.parent / "plugins", folder)
    for line in others:
        assert main(line.split()[1:]) == 0, capsys.readouterr().err


@pytest.mark.parametrize("kind", KINDS)
def test_the_files_that_a_tutorial_names_are_written(kind):
    name = Name(commands(kind)[0].split()[-1])
    files = {place.as_posix() for place in render(KINDS[kind], name)}
    named = set(re.findall(rf"`({name.module}/[\w.]+)`", page(TUTORIALS[kind])))
    assert named <= files


def test_the_command_line_page_names_every_kind_and_its_tutorial():
    rows = table(page("command-line"), "A package to begin with").rows
    assert {row[0].strip("`"): row[2] for row in rows} == {
        kind: f"{{doc}}`{tutorial}`" for kind, tutorial in TUTORIALS.items()
    }
    assert set(KINDS) == set(TUTORIALS)
    assert all((DOCS / f"{tutorial}.md").is_file() for tutorial in TUTORIALS.values())
