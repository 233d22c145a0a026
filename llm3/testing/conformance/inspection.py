"""Applies rules to a plugin, and keeps what they find."""

from __future__ import annotations

import re
import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Any, TypeVar

from llm3 import types
from llm3.errors import LLM3Error, PluginError
from llm3.guarded import place
from llm3.testing.conformance.complaint import Complaint, Report

T = TypeVar("T")

_PLACE = re.compile(r"\(([^()]+:\d+)\)\.?$")
_NOUNS = Path(types.__file__).parent
RAISES = "nothing is raised"
"""The rule that is broken by an exception."""


@dataclass(frozen=True)
class Fault:
    """What a rule finds: see `Complaint`."""

    text: str
    cause: str


Rule = Callable[[T], Iterator[Fault]]
"""A function whose name and docstring are a law, and which tells where something breaks it."""


def name_of(rule: Rule[Any]) -> str:
    """The rule's name as it is told."""
    return getattr(rule, "__name__", str(rule)).replace("_", " ")


class Inspection:
    """A check of one plugin, as it goes on."""

    def __init__(self, instead: str) -> None:
        """Begin.

        Args:
            instead: What plugins of this kind do instead of raising something: the end of a sentence.
        """
        self._instead = instead
        self._complaints: dict[tuple[str, str], Complaint] = {}
        self._remarks: dict[str, None] = {}
        self._rules: set[str] = {RAISES}
        self.worlds = self.actions = self.applied = 0

    def apply(self, rules: Iterable[Rule[T]], subject: T, where: str = "") -> bool:
        """Look at each rule; one in which the plugin raises something is left, and the next is looked at.

        Args:
            rules: The rules.
            subject: What they look at.
            where: What the sentences begin with, such as ``"easy, seed 1"``.

        Returns:
            Whether all of them are kept.
        """
        kept = True
        for rule in rules:
            name = name_of(rule)
            self._rules.add(name)
            try:
                for fault in rule(subject):
                    kept = False
                    self.complain(name, fault, where)
            except (Exception, SystemExit) as error:  # a plugin may raise anything
                kept = False
                self.raised(error, where)
        return kept

    def complain(self, rule: str, fault: Fault, where: str = "") -> None:
        """Keep a complaint, unless the same is known from elsewhere."""
        self._complaints.setdefault((rule, fault.cause), Complaint(rule, _placed(fault.text, where), fault.cause))

    def raised(self, error: BaseException, where: str = "") -> None:
        """Complain of an exception, with the place that raised it; each place once."""
        if self._complaints and _own(error):
            return  # a rule that stumbles over an answer of which another rule has complained
        text = str(error) if isinstance(error, LLM3Error) else _told(error)
        found = _PLACE.search(text)
        noun = _noun(error)
        if noun:
            cause = f"The sentence says what {noun} takes."
        elif found:
            cause = f"An exception ends a run: {self._instead}."
        else:
            cause = "An error ends a run; its sentence says what to change."
        key = found.group(1) if found else text
        self._complaints.setdefault((RAISES, key), Complaint(RAISES, _placed(text, where), cause))

    def stumbled(self, error: BaseException, where: str = "") -> None:
        """Complain of what another plugin raised on the answers of this one, unless a complaint may explain it."""
        if not self._complaints:
            self.raised(error, where)

    def remark(self, text: str) -> None:
        """Keep what is worth knowing and need not be wrong."""
        self._remarks.setdefault(" ".join(text.split()))

    @property
    def report(self) -> Report:
        """What was found so far."""
        return Report(
            tuple(self._complaints.values()),
            tuple(self._remarks),
            len(self._rules),
            self.worlds,
            self.actions,
            self.applied,
        )


def _own(error: BaseException) -> bool:
    """Whether the kit itself raised it, for want of an answer of the right form."""
    frames = list(traceback.walk_tb(error.__traceback__))
    return not isinstance(error, LLM3Error) and _of_the_kit(frames[-1][0])


def _of_the_kit(frame: FrameType) -> bool:
    return Path(frame.f_code.co_filename).parent == Path(__file__).parent


def _placed(text: str, where: str) -> str:
    return f"{where}: {text}" if where else text


def _told(error: BaseException) -> str:
    """The exception, the plugin's method that let it out, and the line that raised it."""
    frames = list(traceback.walk_tb(error.__traceback__))
    here = [i for i, (frame, _) in enumerate(frames) if _of_the_kit(frame)]
    first = min((here[-1] if here else -1) + 1, len(frames) - 1)
    frame = frames[first][0]
    owner = frame.f_locals.get("self")
    name = f"{type(owner).__name__}.{frame.f_code.co_name}" if owner is not None else frame.f_code.co_name
    return f"{name} raised {type(error).__name__}: {error} ({place(error)})."


def _noun(error: BaseException) -> str:
    """The noun of llm3 that was not made, for a value that it does not take; empty where that is not what happened."""
    cause = error.__cause__ if isinstance(error, PluginError) and error.__cause__ else error
    frames = [frame for frame, _ in traceback.walk_tb(cause.__traceback__)]
    if not frames or Path(frames[-1].f_code.co_filename).parent != _NOUNS:
        return ""
    made = [type(frame.f_locals["self"]) for frame in frames if frame.f_code.co_name == "__post_init__"]
    return made[-1].__name__ if made and made[-1].__module__.startswith(types.__name__) else ""
