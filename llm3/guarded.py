"""Calls into plugins, so that a plugin's mistake is told as its own and not as the framework's."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Any, TypeVar

from llm3.errors import LLM3Error, PluginError

T = TypeVar("T")


def guarded(method: Callable[..., T], expected: tuple[type, ...], *arguments: Any) -> T:
    """Call a plugin's method.

    Args:
        method: A bound method, such as ``env.prepare``.
        expected: What it may answer.
        arguments: What it is called with.

    Raises:
        PluginError: It raised something, or answered something else.
    """
    owner = type(getattr(method, "__self__", None)).__name__
    name = f"{owner}.{getattr(method, '__name__', method)}"
    try:
        answer = method(*arguments)
    except LLM3Error:
        raise
    except (Exception, SystemExit) as error:
        raise PluginError(f"{name} raised {type(error).__name__}: {error} ({place(error)}).") from error
    if not isinstance(answer, expected):
        wanted = " or ".join(kind.__name__ for kind in expected)
        raise PluginError(f"{name} must answer {wanted}, not {type(answer).__name__}.")
    return answer


def place(error: BaseException, package: str | None = None) -> str:
    """Where a plugin raised an exception, such as ``env.py:12``.

    What one of llm3's nouns, or a library, raised for a value that it was given is told of the plugin's line that gave
    the value: the last one of the package into which llm3 called.

    Args:
        error: The exception, once it was caught.
        package: The plugin's package; None: the first one on the way that is not llm3, if there is one.

    Returns:
        The place; empty if no line of the package is among those that led to the exception.
    """
    frames = [(_package(frame), frame, line) for frame, line in traceback.walk_tb(error.__traceback__)]
    packages = [package for package, _, _ in frames]
    if package is None:
        package = next((name for name in packages if name != "llm3"), packages[-1])
    places = [f"{Path(frame.f_code.co_filename).name}:{line}" for name, frame, line in frames if name == package]
    return places[-1] if places else ""


def _package(frame: FrameType) -> str:
    return str(frame.f_globals.get("__name__", "")).partition(".")[0]
