from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from in_process import command, cwd, install, plugins, surroundings

from llm3.cli.main import main

__all__ = ["command", "cwd", "install", "plugins", "surroundings"]


@pytest.fixture(autouse=True)
def in_an_empty_folder(cwd: Path) -> None:
    """No test writes where the tests are started."""


@pytest.fixture(scope="session")
def solved_once(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run that was solved in the plane."""
    folder = tmp_path_factory.mktemp("solved") / "run"
    assert main(["--domain", "tabletop2d", "--quiet", "--out", str(folder)]) == 0
    return folder


@pytest.fixture
def solved(solved_once: Path, cwd: Path) -> Path:
    """The same, as `run` in the current folder."""
    return Path(shutil.copytree(solved_once, "run"))
