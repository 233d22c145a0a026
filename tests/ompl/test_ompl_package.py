"""The package: its names, and what is said where OMPL is missing."""

from __future__ import annotations

import json
import sys

import pytest
from command_line import environment, install_corridor, run
from disc_worlds import NAMES

import llm3_ompl.plugin
from llm3 import Registry
from llm3.errors import MissingDependency
from llm3_ompl.planner import OMPLPlanner

WITHOUT = "import sys; sys.modules['ompl'] = None; from llm3.cli.main import main; sys.exit(main({!r}))"


def registry() -> Registry:
    found = Registry()
    found.register(llm3_ompl.plugin, "ompl (test)")
    return found


def test_every_name_makes_a_planner() -> None:
    assert registry().names("planner") == ("ompl-bitstar", "ompl-lbkpiece", "ompl-rrtconnect")
    assert all(isinstance(registry().planner(name), OMPLPlanner) for name in NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_a_missing_ompl_is_one_line_that_says_what_to_install(name: str, monkeypatch) -> None:
    monkeypatch.setattr("llm3_ompl.plugin.find_spec", lambda name: None)
    with pytest.raises(MissingDependency) as caught:
        registry().planner(name)
    assert str(caught.value) == f"the planner {name!r} needs a package that is not installed: pip install 'llm3[ompl]'."


def test_the_names_are_listed_without_ompl(tmp_path) -> None:
    ended = run([sys.executable, "-W", "error", "-c", WITHOUT.format(["list", "--json"])], tmp_path, environment())
    listed = json.loads(ended.out)
    assert listed["broken"] == []
    assert set(NAMES) < {planner["name"] for planner in listed["planner"]}


def test_a_run_without_ompl_ends_with_that_line(tmp_path) -> None:
    install_corridor(tmp_path)
    arguments = ["--domain", "corridor", "--planner", "ompl-rrtconnect", "--quiet"]
    command = [sys.executable, "-W", "error", "-c", WITHOUT.format(arguments)]
    ended = run(command, tmp_path, environment(tmp_path))
    assert ended.code == MissingDependency.exit_code
    assert ended.err == (
        "llm3: error: the planner 'ompl-rrtconnect' needs a package that is not installed: pip install 'llm3[ompl]'.\n"
    )
    assert not (tmp_path / "runs").exists()
