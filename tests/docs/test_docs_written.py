"""What a script writes into the manual is what it would write now."""

from __future__ import annotations

import importlib.util

import pytest
from docs_pages import DOCS, page

from llm3.cli.check_command import KINDS
from llm3.cli.main import COMMANDS, build_parser
from llm3.testing.conformance.laws import laws


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("docs_written", DOCS / "written.py")
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("name", ["command-line", "rules"])
def test_the_page_is_what_would_be_written(script, name):
    text = page(name)
    assert script.rewritten(text, f"{name}.md") == text, "run docs/written.py"
    assert set(script.PAGES) == {"command-line.md", "rules.md"}


def test_the_command_line_has_the_help_of_every_command():
    for command in COMMANDS:
        assert build_parser(command).format_help() in page("command-line")


def test_the_rules_are_told_with_their_laws():
    assert tuple(laws()) == KINDS
    for law in (law for of_kind in laws().values() for law in of_kind):
        assert f"| {law.name} | {law.text} |" in page("rules")
        assert law.text.endswith(".")
