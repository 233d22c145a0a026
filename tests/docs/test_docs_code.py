from __future__ import annotations

import ast
import re
import shlex
import sys
import types
from pathlib import Path

import pytest
from docs_pages import DOCS, Block, blocks, page

from llm3 import Registry, Strategy
from llm3.cli.main import main


def options(block: Block) -> dict[str, str]:
    return {m[1]: m[2].strip('"') for m in re.finditer(r"^:([\w-]+): ?(.*)$", block.text, re.MULTILINE)}


def included(block: Block) -> tuple[Path, range]:
    """The file that a literalinclude shows, and its lines, counted from 1."""
    file = (DOCS / block.info.split()[1]).resolve()
    source = file.read_text(encoding="utf-8")
    lines, wanted = source.splitlines(), options(block)
    first, last = 1, len(lines)
    if "pyobject" in wanted:
        nodes = ast.parse(source).body
        for name in wanted["pyobject"].split("."):
            (node,) = [n for n in nodes if getattr(n, "name", None) == name]
            nodes = getattr(node, "body", [])
        decorators = [d.lineno for d in node.decorator_list]
        return file, range(min([node.lineno, *decorators]), node.end_lineno + 1)
    if "start-at" in wanted:
        first = next(n for n, line in enumerate(lines, 1) if wanted["start-at"] in line)
    if "end-before" in wanted:
        last = next(n for n, line in enumerate(lines, 1) if n > first and wanted["end-before"] in line) - 1
    return file, range(first, last + 1)


def test_the_tutorial_is_the_package_and_nothing_else():
    text = page("first-domain")
    shown: dict[Path, set[int]] = {}
    for block in blocks(text, "{literalinclude}"):
        file, lines = included(block)
        shown.setdefault(file, set()).update(lines)
    package = (DOCS.parent / "tests" / "third_party" / "llm3_corridor").resolve()
    files = {f for f in package.rglob("*") if f.suffix in (".py", ".toml")}
    assert set(shown) == files
    for file, lines in shown.items():
        left_out = [n for n, line in enumerate(file.read_text().splitlines(), 1) if line.strip() and n not in lines]
        assert not left_out, f"{file.name}: the tutorial leaves out lines {left_out}"


def test_the_run_in_the_tutorial_goes_as_it_says(corridor, capfd):
    (transcript,) = [b.text for b in blocks(page("first-domain"), "console") if "attempt 1" in b.text]
    command, expected = re.findall(r"^\$ llm3 (.*)\n((?:[^$].*\n)*)", transcript, re.MULTILINE)[0]
    assert main(shlex.split(command)) == 0
    printed = capfd.readouterr()

    def without_time(text: str) -> str:
        return re.sub(r"solved in [\d.]+ s", "solved", text)

    assert without_time(printed.err + printed.out) == without_time(expected)


def test_the_code_on_the_python_page_runs_and_prints_what_it_says(corridor, capsys):
    code = blocks(page("python"), "python")
    namespace: dict[str, object] = {}
    for block in code:
        padding = "\n" * block.line  # so that an error names the line of the page
        exec(compile(padding + block.text, "docs/python.md", "exec"), namespace)
    printed = capsys.readouterr().out
    promised = re.findall(r"print\(.*\)  # (.*[.)\]}])$", "".join(b.text for b in code), re.MULTILINE)
    assert len(promised) == 2
    for line in promised:
        assert line + "\n" in printed


@pytest.fixture
def my_package(tmp_path, monkeypatch):
    """The package that the examples speak of."""
    folder = tmp_path / "my_package"
    folder.mkdir()
    (folder / "__init__.py").write_text("")
    monkeypatch.syspath_prepend(tmp_path)
    yield folder
    sys.modules.pop("my_package", None)


def test_the_examples_of_the_hooks_page_are_plugins():
    registry = Registry()
    for number, block in enumerate(b for b in blocks(page("hooks"), "python") if "llm3_feedback" not in b.text):
        plugin = types.ModuleType(f"example_{number}")
        exec(block.text, plugin.__dict__)
        registry.register(plugin, plugin.__name__)
    assert registry.names("domain") == ("kitchen",)
    assert registry.names("planner") == ("prm",)
    assert registry.names("backend") == ("local",)
    assert registry.strategy("brief") == Strategy("my_package", "brief.j2", "Ask in few words.")


def test_the_feedback_example_is_a_plugin_once_its_package_is_there(my_package):
    (my_package / "feedback.py").write_text("class Drawn: pass\n")
    (block,) = [b for b in blocks(page("hooks"), "python") if "llm3_feedback" in b.text]
    registry, plugin = Registry(), types.ModuleType("example")
    exec(block.text, plugin.__dict__)
    registry.register(plugin, "example")
    assert registry.names("feedback") == ("drawn",)
    sys.modules.pop("my_package.feedback")
