"""The pages of the manual, taken apart."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"


@dataclass(frozen=True)
class Block:
    """A fenced block of code: what its first fence says, and what is inside."""

    info: str
    text: str
    line: int


@dataclass(frozen=True)
class Table:
    heading: str
    """The nearest heading above it."""
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    @property
    def names(self) -> tuple[str, ...]:
        """Every `name` in the first column."""
        return tuple(name for row in self.rows for name in names(row[0]))


def page(name: str) -> str:
    return (DOCS / f"{name}.md").read_text(encoding="utf-8")


def blocks(text: str, info: str = "") -> list[Block]:
    """The fenced blocks whose first fence begins so."""
    found = re.finditer(r"^```(\S.*)\n((?:.*\n)*?)^```$", text, re.MULTILINE)
    all_ = [Block(m[1], m[2], text.count("\n", 0, m.start()) + 1) for m in found]
    return [block for block in all_ if block.info.startswith(info)]


def names(text: str) -> tuple[str, ...]:
    """Everything that stands in backticks."""
    return tuple(re.findall(r"`([^`]+)`", text))


def tables(text: str) -> list[Table]:
    found: list[Table] = []
    heading, rows = "", []
    for line in [*text.splitlines(), ""]:
        if line.startswith("|"):
            rows.append(tuple(cell.strip() for cell in line.strip("|").split("|")))
        elif rows:
            columns, _, *body = rows
            found.append(Table(heading, columns, tuple(body)))
            rows = []
        if line.startswith("#"):
            heading = line.lstrip("# ")
    return found


def table(text: str, heading: str, column: str | None = None) -> Table:
    """The one table under a heading, or the one there whose first column is called so."""
    (found,) = [t for t in tables(text) if t.heading == heading and column in (None, t.columns[0])]
    return found
