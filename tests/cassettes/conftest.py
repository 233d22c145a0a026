from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from command_line import FOREIGN, Ended, environment, install_corridor
from corridor_replies import SCRIPT

from llm3.cli.main import main


@pytest.fixture
def plugins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of installed plugins, in which the corridor is."""
    folder = tmp_path / "plugins"
    folder.mkdir()
    install_corridor(folder)
    monkeypatch.syspath_prepend(folder)
    return folder


@pytest.fixture
def cwd(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder to work in, but for a script of replies."""
    folder = tmp_path / "work"
    folder.mkdir()
    monkeypatch.chdir(folder)
    (folder / "replies.json").write_text(json.dumps(SCRIPT), encoding="utf-8")
    return folder


@pytest.fixture
def command(
    plugins: Path, cwd: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Callable[[str], Ended]:
    """Runs llm3 in this process; its arguments are one line without quotes."""
    for name in list(os.environ):
        if name.startswith(FOREIGN) or name.lower().endswith("_proxy"):
            monkeypatch.delenv(name)

    def run(line: str) -> Ended:
        capsys.readouterr()
        code = main(line.split())
        printed = capsys.readouterr()
        return Ended(code, printed.out, printed.err)

    return run


@pytest.fixture
def recorded(command: Callable[[str], Ended]) -> Ended:
    """A solved run of four prompts, with its record in `first` and its cassette in `tape.jsonl`."""
    ended = command("--domain corridor --seed 7 --llm scripted:replies.json --out first --record tape.jsonl")
    assert ended.code == 0
    return ended


@pytest.fixture
def surroundings(plugins: Path) -> Mapping[str, str]:
    """The environment of a subprocess that finds the same plugins."""
    return environment(plugins)
