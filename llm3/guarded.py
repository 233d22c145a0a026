"""Calls into plugins, so that a plugin's mistake is told as its own and not as the framework's."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from pathlib import Path
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
        raise PluginError(f"{name} raised {type(error).__name__}: {error} ({_place(error)}).") from error
    if not isinstance(answer, expected):
        wanted = " or ".join(kind.__name__ for kind in expected)
        raise PluginError(f"{name} must answer {wanted}, not {type(answer).__name__}.")
    return answer


def _place(error: BaseException) -> str:
    last = traceback.extract_tb(error.__traceback__)[-1]
    return f"{Path(last.filename).name}:{last.lineno}"
