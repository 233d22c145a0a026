from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from command_line import install_package
from in_process import Command, command, cwd, install, plugins, surroundings

__all__ = ["command", "cwd", "install", "plugins", "surroundings"]

New = Callable[..., Path]


@pytest.fixture
def new(command: Command, cwd: Path, plugins: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[New]:
    """Makes a package by `llm3 new`, installs it as pip would, and answers its folder."""
    before = set(sys.modules)

    def make(kind: str, name: str, *flags: str) -> Path:
        ended = command("new", kind, name, *flags)
        assert (ended.code, ended.err) == (0, ""), ended.err
        folder = cwd / name
        install_package(plugins, folder)
        monkeypatch.syspath_prepend(plugins)  # forget what was found there before
        return folder

    yield make
    for module in set(sys.modules) - before:
        if str(getattr(sys.modules[module], "__file__", None) or "").startswith(str(plugins)):
            del sys.modules[module]
