"""Fixtures that run llm3 in this process, in an empty folder, with the corridor installed. A conftest imports them."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from importlib import metadata
from pathlib import Path

import pytest
from command_line import FOREIGN, Ended, environment, install_corridor, install_plugin

from llm3.cli.main import main

Command = Callable[..., Ended]


@pytest.fixture
def cwd(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to work in."""
    folder = tmp_path / "work"
    folder.mkdir()
    monkeypatch.chdir(folder)
    return folder


@pytest.fixture
def plugins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of installed plugins, in which the corridor is."""
    folder = tmp_path / "plugins"
    folder.mkdir()
    install_corridor(folder)
    monkeypatch.syspath_prepend(folder)
    everything = metadata.entry_points

    def of_these_tests(**wanted: str) -> list[metadata.EntryPoint]:
        """What ships with llm3 and what a test installed, without what else is in the environment."""
        return [
            entry_point
            for entry_point in everything(**wanted)
            if entry_point.dist
            and (entry_point.dist.name == "llm3" or Path(str(entry_point.dist.locate_file(""))) == folder)
        ]

    monkeypatch.setattr(metadata, "entry_points", of_these_tests)
    return folder


@pytest.fixture
def command(plugins: Path, cwd: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Command:
    """Runs llm3; its arguments are one line without quotes, or several words."""
    for name in list(os.environ):
        if name.startswith(FOREIGN) or name.lower().endswith("_proxy"):
            monkeypatch.delenv(name)

    def run(*arguments: str) -> Ended:
        words = arguments[0].split() if len(arguments) == 1 else list(arguments)
        capsys.readouterr()
        code = main(words)
        printed = capsys.readouterr()
        return Ended(code, printed.out, printed.err)

    return run


@pytest.fixture
def install(plugins: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[[str, str], None]:
    """Installs a plugin of one module; its name must be new in this process."""

    def add(name: str, source: str) -> None:
        install_plugin(plugins, name, source)
        monkeypatch.syspath_prepend(plugins)  # forget what was found there before

    return add


@pytest.fixture
def surroundings(plugins: Path) -> Mapping[str, str]:
    """The environment of a subprocess that finds the same plugins."""
    return environment(plugins)
