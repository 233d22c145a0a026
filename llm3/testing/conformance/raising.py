"""What is told of an exception that a plugin raised."""

from __future__ import annotations

import re
import traceback
from pathlib import Path
from types import FrameType

from llm3 import types
from llm3.errors import LLM3Error, PluginError
from llm3.guarded import place
from llm3.types import Action

_PLACE = re.compile(r"\(([^()]+:\d+)\)\.?$")
_NOUNS = Path(types.__file__).parent
_OF_THE_INSTANCE = re.compile(r"(?=.*(abstract class|no setter|can't set attribute)).*\b(task|schemas|objects)\b")


def own(error: BaseException) -> bool:
    """Whether the kit itself raised it, for want of an answer of the right form."""
    frames = list(traceback.walk_tb(error.__traceback__))
    return not isinstance(error, LLM3Error) and _of_the_kit(frames[-1][0])


def told(error: BaseException) -> str:
    """The exception, the plugin's method that let it out, and the line that raised it."""
    if isinstance(error, LLM3Error):
        return str(error)
    frames = list(traceback.walk_tb(error.__traceback__))
    here = [i for i, (frame, _) in enumerate(frames) if _of_the_kit(frame)]
    first = min((here[-1] if here else -1) + 1, len(frames) - 1)
    frame = frames[first][0]
    owner = frame.f_locals.get("self")
    name = f"{type(owner).__name__}.{frame.f_code.co_name}" if owner is not None else frame.f_code.co_name
    return f"{name} raised {type(error).__name__}: {error} ({place(error)})."


def line(text: str) -> str:
    """The line of the plugin that stands at the end of such a sentence; the sentence where there is none."""
    found = _PLACE.search(text)
    return found.group(1) if found else text


def cause(error: BaseException, text: str, instead: str) -> str:
    """What is most likely behind an exception.

    Args:
        error: The exception.
        text: What is told of it.
        instead: What plugins of this kind do instead of raising something: the end of a sentence.
    """
    if noun := _noun(error):
        return f"The sentence says what {noun} takes."
    if isinstance(error, TypeError | AttributeError) and _OF_THE_INSTANCE.search(str(error)):
        return "What varies by instance is a @property of the Env that answers it: it cannot be set in __init__."
    if line(text) != text:
        return f"An exception ends a run: {instead}."
    return "An error ends a run; its sentence says what to change."


def action_of(error: BaseException) -> str:
    """The action that was asked for when it was raised; empty if none was."""
    frames = [frame for frame, _ in traceback.walk_tb(error.__traceback__) if _of_llm3(frame)]
    actions = [frame.f_locals.get("action") for frame in frames]
    return next((str(action) for action in reversed(actions) if isinstance(action, Action)), "")


def _of_the_kit(frame: FrameType) -> bool:
    return Path(frame.f_code.co_filename).parent == Path(__file__).parent


def _of_llm3(frame: FrameType) -> bool:
    return str(frame.f_globals.get("__name__", "")).startswith("llm3.")


def _noun(error: BaseException) -> str:
    """The noun of llm3 that was not made, for a value that it does not take; empty where that is not what happened."""
    reason = error.__cause__ if isinstance(error, PluginError) and error.__cause__ else error
    frames = [frame for frame, _ in traceback.walk_tb(reason.__traceback__)]
    if not frames or Path(frames[-1].f_code.co_filename).parent != _NOUNS:
        return ""
    made = [type(frame.f_locals["self"]) for frame in frames if frame.f_code.co_name == "__post_init__"]
    return made[-1].__name__ if made and made[-1].__module__.startswith(types.__name__) else ""
