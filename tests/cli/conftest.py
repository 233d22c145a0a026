from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from in_process import Command, command, cwd, install, plugins, surroundings

__all__ = ["command", "cwd", "install", "plugins", "surroundings"]


@pytest.fixture(autouse=True)
def in_an_empty_folder(cwd: Path) -> None:
    """No test writes where the tests are started."""


@pytest.fixture
def corridor(command: Command) -> Command:
    """Runs `llm3 --domain corridor` with more arguments."""
    return lambda line="": command(f"--domain corridor {line}")


@pytest.fixture
def script(cwd: Path) -> Callable[..., str]:
    """The flags with which a run reads these replies from a file."""

    def write(*replies: str) -> str:
        (cwd / "replies.json").write_text(json.dumps(replies), encoding="utf-8")
        return "--llm scripted:replies.json"

    return write
