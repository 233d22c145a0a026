"""toppra without its plots."""

from __future__ import annotations

import importlib
import sys
from types import ModuleType
from typing import Any


class _Later(ModuleType):
    """Stands for a module until something in it is asked for."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return getattr(importlib.import_module(self.__name__), name)


def import_toppra() -> Any:
    """The package toppra.

    It imports pyplot for one method that draws. That takes longer than all the rest, and the first time it lists the
    machine's fonts and writes the list to the user's home. So pyplot is imported once somebody draws.
    """
    if "toppra" in sys.modules or "matplotlib" in sys.modules:
        return importlib.import_module("toppra")
    package, pyplot = _Later("matplotlib"), _Later("matplotlib.pyplot")
    vars(package)["pyplot"] = pyplot
    sys.modules.update({"matplotlib": package, "matplotlib.pyplot": pyplot})
    try:
        return importlib.import_module("toppra")
    finally:
        for name in ("matplotlib", "matplotlib.pyplot"):
            del sys.modules[name]
