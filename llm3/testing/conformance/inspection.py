"""Applies rules to a plugin, and keeps what they find."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, TypeVar

from llm3.testing.conformance.complaint import Complaint, Report
from llm3.testing.conformance.raising import action_of, cause, line, own, told

T = TypeVar("T")

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
        """Complain of an exception, with the action and the place that raised it; each place once."""
        if self._complaints and own(error):
            return  # a rule that stumbles over an answer of which another rule has complained
        text = told(error)
        action = action_of(error) if where else ""
        complaint = Complaint(
            RAISES,
            _placed(text, ", ".join(filter(None, (where, action)))),
            cause(error, text, self._instead),
        )
        self._complaints.setdefault((RAISES, line(text)), complaint)

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


def _placed(text: str, where: str) -> str:
    return f"{where}: {text}" if where else text
