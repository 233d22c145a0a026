"""What the kit has to say of a plugin."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Complaint:
    """A rule that a plugin breaks."""

    rule: str
    """The rule, such as ``"prepare depends on its arguments alone"``."""
    text: str
    """What is wrong and where, with values: a sentence."""
    cause: str
    """What is most likely behind it, or what to do: a sentence."""

    def __post_init__(self) -> None:
        for name in ("rule", "text", "cause"):
            object.__setattr__(self, name, " ".join(getattr(self, name).split()))

    def __str__(self) -> str:
        """One line: what is wrong, and the likely cause."""
        return f"{self.text} {self.cause}"


@dataclass(frozen=True)
class Report:
    """All that a check found."""

    complaints: tuple[Complaint, ...]
    """One for each fault: what has the same rule and the same cause elsewhere is not told again."""
    remarks: tuple[str, ...]
    """What could not be looked at, and what need not be wrong: sentences."""
    rules: int
    """How many rules were looked at."""
    worlds: int = 0
    """How many problems of a domain."""
    actions: int = 0
    """How many actions were tried in them."""
    applied: int = 0
    """How many of those could be carried out."""
