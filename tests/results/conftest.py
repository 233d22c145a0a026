from __future__ import annotations

from in_process import command, cwd, install, plugins

__all__ = ["command", "cwd", "install", "plugins"]
