from __future__ import annotations

import json
from pathlib import Path

import pytest
from command_line import Ended
from corridor_replies import SCRIPT
from in_process import Command, command, cwd, plugins, surroundings

__all__ = ["command", "cwd", "plugins", "surroundings"]


@pytest.fixture(autouse=True)
def replies(cwd: Path) -> None:
    """A script of replies in the working folder."""
    (cwd / "replies.json").write_text(json.dumps(SCRIPT), encoding="utf-8")


@pytest.fixture
def recorded(command: Command) -> Ended:
    """A solved run of four prompts, with its record in `first` and its cassette in `tape.jsonl`."""
    ended = command("--domain corridor --seed 7 --llm scripted:replies.json --out first --record tape.jsonl")
    assert ended.code == 0
    return ended
