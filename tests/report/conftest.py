from in_process import command, cwd, plugins

__all__ = ["command", "cwd", "plugins"]
