"""A planted fault, and the sentence that must name it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

from llm3.testing import Complaint


@dataclass(frozen=True)
class Planted:
    plugin: Any
    rule: str
    text: str
    """The whole sentence on what is wrong; … stands for figures that may be any."""
    likely: str
    """A part of the sentence on the cause."""
    seeds: tuple[int, ...] = (0,)

    def found_in(self, complaints: tuple[Complaint, ...]) -> bool:
        text = ".*".join(map(re.escape, self.text.split("…")))
        return any(
            c.rule == self.rule and re.fullmatch(rf"(?:small, seed \d: )?{text}", c.text) and self.likely in c.cause
            for c in complaints
        )
