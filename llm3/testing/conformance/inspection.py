"""Applies rules to a plugin, and keeps what they find."""

from __future__ import annotations

import re
import traceback
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import TypeVar

from llm3.errors import LLM3Error
from llm3.testing.conformance.complaint import Complaint, Report

T = TypeVar("T")

_PLACE = re.compile(r"\(([^()]+:\d+)\)\.?$")
RAISES = "nothing is raised"
"""The rule that is broken by an exception."""


@dataclass(frozen=True)
class Fault:
    """What a rule finds: see `Complaint`."""

    text: str
    cause: str


Rule = Callable[[T], Iterator[Fault]]
"""A function whose name and docstring are a law, and which tells where something breaks it."""


class Inspection:
    """A check of one plugin, as it goes on."""

    def __init__(self) -> None:
        self._complaints: dict[tuple[str, str], Complaint] = {}
        self._remarks: dict[str, None] = {}
        self._rules: set[str] = {RAISES}
        self.worlds = self.actions = self.applied = 0

    def apply(self, rules: Iterable[Rule[T]], subject: T, where: str = "") -> None:
        """Look at each rule; one in which the plugin raises something is left, and the next is looked at.

        Args:
            rules: The rules.
            subject: What they look at.
            where: What the sentences begin with, such as ``"easy, seed 1"``.
        """
        for rule in rules:
            name = getattr(rule, "__name__", str(rule)).replace("_", " ")
            self._rules.add(name)
            try:
                for fault in rule(subject):
                    self.complain(name, fault, where)
            except (Exception, SystemExit) as error:  # a plugin may raise anything
                self.raised(error, where)

    def complain(self, rule: str, fault: Fault, where: str = "") -> None:
        """Keep a complaint, unless the same is known from elsewhere."""
        self._complaints.setdefault((rule, fault.cause), Complaint(rule, _placed(fault.text, where), fault.cause))

    def raised(self, error: BaseException, where: str = "") -> None:
        """Complain of an exception, with the place that raised it; each place once."""
        if self._complaints and _own(error):
            return  # a rule that stumbles over an answer of which another rule has complained
        text = str(error) if isinstance(error, LLM3Error) else _told(error)
        place = _PLACE.search(text)
        if place:
            cause = "An exception ends a run: what the robot cannot do is a Failure, and not an exception."
        else:
            cause = "An error ends a run; its sentence says what to change."
        key = place.group(1) if place else text
        self._complaints.setdefault((RAISES, key), Complaint(RAISES, _placed(text, where), cause))

    def refused(self, error: LLM3Error, where: str = "") -> None:
        """Complain of an error; of one that names no place only if no other complaint may explain it."""
        if not self._complaints or _PLACE.search(str(error)):
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
    last, line = frames[-1]
    return f"{name} raised {type(error).__name__}: {error} ({Path(last.f_code.co_filename).name}:{line})."
