"""Sections as plain text, aligned for a terminal."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from rich.cells import cell_len

from llm3.results.table import Section, Table

GAP = "  "


def as_text(sections: Iterable[Section]) -> str:
    """The sections one after another; lines are as long as they need to be."""
    blocks = []
    for section in sections:
        blocks.append([section.title, "=" * cell_len(section.title)])
        lines: list[str] = []
        for item in section.content:
            if isinstance(item, str):
                lines.append(item)
            else:
                blocks += [lines, list(_table(item))]
                lines = []
        blocks.append(lines)
    return "\n\n".join("\n".join(line.rstrip() for line in block) for block in blocks if block) + "\n"


def _table(table: Table) -> Iterator[str]:
    if table.title:
        yield table.title
        yield ""
    widths = [
        max(cell_len(text) for text in (heads[-1], *(row[column] for row in table.rows)))
        for column, heads in enumerate(table.heads)
    ]
    for level in table.levels:
        first = 0
        for text, columns in level:  # a head may be wider than what stands under it
            needed = cell_len(text) - sum(widths[first : first + columns]) - len(GAP) * (columns - 1)
            widths[first + columns - 1] += max(0, needed)
            first += columns
    for level in table.levels[:-1]:
        yield _heads(level, widths)
    yield _line([text for text, _ in table.levels[-1]], widths, table.names)
    yield GAP.join("-" * width for width in widths)
    for row in table.rows:
        yield _line(row, widths, table.names)
    if table.notes:
        yield ""
        yield from table.notes


def _heads(level: Sequence[tuple[str, int]], widths: Sequence[int]) -> str:
    texts, first = [], 0
    for text, columns in level:
        width = sum(widths[first : first + columns]) + len(GAP) * (columns - 1)
        left = (width - cell_len(text)) // 2
        texts.append(" " * left + text + " " * (width - cell_len(text) - left))
        first += columns
    return GAP.join(texts)


def _line(texts: Sequence[str], widths: Sequence[int], names: int) -> str:
    spaces = [" " * (width - cell_len(text)) for text, width in zip(texts, widths, strict=True)]
    cells = [t + s if i < names else s + t for i, (t, s) in enumerate(zip(texts, spaces, strict=True))]
    return GAP.join(cells)
