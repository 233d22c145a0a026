from in_process import command, cwd, install, plugins, surroundings

__all__ = ["command", "cwd", "install", "plugins", "surroundings"]
