"""Every tutorial begins with a package that `llm3 new` writes: its commands do what the page says."""

from __future__ import annotations

import importlib
import re
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from command_line import install_package
from docs_pages import DOCS, blocks, page, table

from llm3 import Prompt, Registry, solve
from llm3.cli.main import main
from llm3.cli.text import printable
from llm3.scaffold import KINDS, Name, render
from llm3.testing import Complaint, ScriptedLLM, check_domain
from llm3.testing.scripted import stand_in_script
from llm3.types import Motion, Noise, Segment

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


@pytest.fixture
def begin(corridor: Path, forgotten_afterwards, monkeypatch: pytest.MonkeyPatch) -> Callable[[str], tuple[str, ...]]:
    """Makes and installs the package of a tutorial, and answers the other commands."""

    def make(kind: str) -> tuple[str, ...]:
        new, install, *others = commands(kind)
        assert main(new.split()[1:]) == 0
        install_package(corridor.parent / "plugins", corridor / install.split()[-1])
        monkeypatch.syspath_prepend(corridor.parent / "plugins")  # forget what was found there before
        return (install, *others)

    return make


def run(name: str) -> dict[str, object]:
    """Run the code of a page, block after block, and answer its names."""
    namespace: dict[str, object] = {}
    for block in blocks(page(name), "python"):
        exec(compile("\n" * block.line + block.text, f"docs/{name}.md", "exec"), namespace)  # an error names its line
    return namespace


@pytest.mark.parametrize("kind", KINDS)
def test_the_first_commands_work_and_are_those_that_the_program_prints(begin, capsys, kind):
    install, *others, tests = begin(kind)
    printed = [printable(line) for line in capsys.readouterr().out.splitlines()[1:]]
    assert printed == [install, *others, tests]
    for line in others:
        assert main(line.split()[1:]) == 0, capsys.readouterr().err


@pytest.mark.parametrize("kind", KINDS)
def test_every_other_command_works_too_a_stand_in_takes_the_place_of_a_model(begin, capsys, kind):
    shown = "".join(block.text for block in blocks(page(TUTORIALS[kind]), "console"))
    others = set(re.findall(r"^\$ (llm3 .*)$", shown, re.MULTILINE)) - set(commands(kind))
    begin(kind)
    for line in others:
        assert main(line.removesuffix(" --model NAME").split()[1:]) == 0, line + capsys.readouterr().err


@pytest.mark.parametrize("name", ["own-planner", "own-feedback", "own-model"])
def test_the_code_of_a_tutorial_runs(corridor, name):
    assert run(name)["result"].solved


def test_the_code_on_strategies_runs_with_the_package_that_the_page_begins_with(begin):
    begin("strategy")
    assert run("own-strategy")["result"].solved


def test_a_door_cannot_be_taken_and_who_does_not_refuse_it_is_told_so(begin):
    begin("domain")
    with_door = run("first-domain")["WithDoor"]
    rooms = importlib.import_module("llm3_my_rooms.domain").MyRoomsDomain

    def checked(env: type) -> tuple[Complaint, ...]:
        return check_domain(type("Doors", (rooms,), {"make": lambda self, instance, options: env(instance)})())

    assert checked(with_door) == ()
    careless = type("Careless", (with_door,), {"prepare": with_door.__base__.prepare})
    (complaint,) = checked(careless)
    assert "take(['door'], {}): Careless.prepare raised KeyError: 'door'" in str(complaint)


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


def test_the_extras_of_a_domain_are_whole_and_the_second_look_sees_what_is_wrong(corridor, forgotten_afterwards):
    names = run("domain-extras")
    domain = names["Corridors"]()
    assert check_domain(domain) == ()
    instance = domain.instance("default", 0)
    env, registry = domain.make(instance, {}), Registry.discover()
    result = solve(
        env,
        backend=ScriptedLLM(stand_in_script(domain.stand_in())),
        planner=registry.planner("birrt"),
        feedback=registry.feedback("none"),
        prompt=Prompt(registry.strategy("backtrack")),
    )
    assert result.solved
    look = domain.verifier(instance, {}).verify
    assert look(result.start, result.plan).sound
    through = replace(result.plan[1], motion=Motion((Segment("transit", ((0.5, 0.0), (1.9, 0.0))),)))
    sentences = [defect.sentence for defect in look(result.start, (result.plan[0], through)).defects]
    assert sentences == [
        "the robot is not where its motion begins",
        "the robot walks through the wall",
        "the robot is not where the state says",
    ]
    assert not look(result.start, result.plan[:1]).sound
    for noise, reached in ((Noise(), True), (Noise(joints=5.0), False)):
        executor = domain.executor(instance, {}, noise)
        done = executor.execute(result.start, result.plan, np.random.default_rng(0))
        assert (env.goal(done.state).achieved, any(action.slips for action in done.actions)) == (reached, not reached)
    assert "near y = " in names["NamedGap"](instance).task
