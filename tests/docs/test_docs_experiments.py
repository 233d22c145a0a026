from __future__ import annotations

import shlex
from dataclasses import fields
from pathlib import Path

import pytest
from docs_pages import ROOT, blocks, page, table

from llm3.cli.main import main
from llm3.experiments import MEASURES, Budgets, RunLine, experiment_of, parse_toml
from llm3.experiments.toml_file import METHOD_FIELDS, ExperimentTable
from llm3.registry import Registry


@pytest.fixture
def written() -> str:
    (block,) = blocks(page("experiments"), "toml")
    return block.text


def commands() -> list[str]:
    """Every command of the page, as far as it starts an experiment."""
    lines = "".join(block.text for block in blocks(page("experiments"), "console")).splitlines()
    return [line[2:].partition("#")[0].strip() for line in lines if line.startswith("$ llm3 experiment")]


def test_the_fields_of_a_file_are_those_that_are_read():
    assert set(table(page("experiments"), "Write one").names) == {field.name for field in fields(ExperimentTable)}


def test_every_field_of_a_method_and_every_measure_is_named():
    text = page("experiments")
    for name in (*METHOD_FIELDS, *MEASURES, *(field.name for field in fields(Budgets))):
        assert f"`{name}`" in text


def test_the_fields_of_a_line_are_those_that_are_written():
    lines = table(page("experiments"), "What it leaves", "field")
    assert [row[0].strip("`") for row in lines.rows] == [field.name for field in fields(RunLine)]


def test_what_ships_is_as_the_page_says():
    registry = Registry.discover()
    told = {row[0].strip("`"): tuple(map(int, row[2:])) for row in table(page("experiments"), "What ships").rows}
    for name, counts in told.items():
        experiment = experiment_of(parse_toml(registry.experiment(name), name), name)
        assert (len(experiment.methods), len(experiment.problems), len(experiment.seeds)) == counts
    ours = [r.name for r in registry.registrations("experiment") if r.plugin.startswith("boxpack (llm3 ")]
    assert sorted(told) == ours


@pytest.mark.parametrize("command", commands())
def test_its_commands_are_commands(command, written, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("OPENAI_API_KEY", "none")
    Path("mine.toml").write_text(written, encoding="utf-8")
    words = shlex.split(command)[1:]
    assert main([*words, *([] if "--dry-run" in words else ["--dry-run"])]) == 0
    assert "at most " in capsys.readouterr().out


def test_the_example_says_what_it_seems_to_say(written):
    experiment = experiment_of(parse_toml(written, "mine.toml"), "mine.toml")
    assert [method.name for method in experiment.methods] == ["rules", "random", "search"]
    assert [problem.name for problem in experiment.problems] == ["easy-small", "hard-large"]
    assert experiment.budgets == Budgets(llm_calls=(1, 5, 20), motion_calls=(10, 50, 200))
    assert len(experiment) == 30


def test_the_readme_counts_as_a_dry_run_does(tmp_path, monkeypatch, capsys):
    (line,) = [line for line in (ROOT / "README.md").read_text(encoding="utf-8").splitlines() if "--dry-run" in line]
    command, _, told = line.partition("#")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("OPENAI_API_KEY", "none")
    assert main(shlex.split(command)[1:]) == 0
    printed = capsys.readouterr().out
    runs, calls = (part.strip() for part in told.split(", "))
    assert f"table1: {runs}, of 4 methods" in printed
    assert f"{calls} of a language model\n" in printed
