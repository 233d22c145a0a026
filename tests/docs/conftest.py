from __future__ import annotations

from pathlib import Path

import pytest
from command_line import install_corridor


@pytest.fixture
def corridor(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The tutorial's package is installed, and the current folder is empty."""
    plugins, work = tmp_path / "plugins", tmp_path / "work"
    plugins.mkdir()
    work.mkdir()
    install_corridor(plugins)
    monkeypatch.syspath_prepend(plugins)
    monkeypatch.chdir(work)
    return work
