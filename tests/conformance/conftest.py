from __future__ import annotations

from in_process import Command, command, cwd, install, plugins

__all__ = ["Command", "command", "cwd", "install", "plugins"]
