"""A table of texts, before it is known how it is written."""

from __future__ import annotations

from dataclasses import dataclass

Span = tuple[str, int]
"""A head and how many columns it stands over."""
POOLED = "all problems"


@dataclass(frozen=True)
class Table:
    """Rows of texts below one or more rows of heads."""

    title: str
    heads: tuple[tuple[str, ...], ...]
    """The heads of each column from the top down, equally many for every column."""
    rows: tuple[tuple[str, ...], ...]
    """A text for each column."""
    notes: tuple[str, ...] = ()
    """Lines below it."""
    names: int = 1
    """How many columns from the left hold names and not numbers."""

    @property
    def levels(self) -> tuple[tuple[Span, ...], ...]:
        """The rows of heads, where neighbours that share a head, and those above it, are one."""
        found = []
        for level in range(len(self.heads[0])):
            spans: list[Span] = []
            above: tuple[str, ...] = ()
            for column, heads in enumerate(self.heads):
                same = spans and heads[: level + 1] == above and level < len(heads) - 1 and column >= self.names
                spans = [*spans[:-1], (heads[level], spans[-1][1] + 1)] if same else [*spans, (heads[level], 1)]
                above = heads[: level + 1]
            found.append(tuple(spans))
        return tuple(found)


@dataclass(frozen=True)
class Section:
    """A heading, with lines and tables below it."""

    title: str
    content: tuple[Table | str, ...]


def one_line(text: str) -> str:
    """Without control characters and line breaks, whoever wrote it."""
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())


def problem_title(name: str | None) -> str:
    """What a row calls a problem; None stands for all of them."""
    return POOLED if name is None else one_line(name)
