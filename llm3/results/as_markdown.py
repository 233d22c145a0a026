"""Sections in Markdown, with tables as GitHub reads them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from llm3.results.table import Section, Table

_SPECIAL = re.compile(r"([\\`*_<>|~]|\](?=[(\[]))")
"""What means something to Markdown wherever it stands; brackets do before others."""


def as_markdown(sections: Iterable[Section]) -> str:
    """The sections one after another. Heads over several columns stand in each of them."""
    blocks: list[str] = []
    for section in sections:
        blocks.append(f"## {_escaped(section.title)}")
        lines: list[str] = []
        for item in section.content:
            if isinstance(item, str):
                lines.append(f"- {_escaped(item)}")
            else:
                blocks += ["\n".join(lines), "\n".join(_table(item)), "\n".join(f"- {_escaped(n)}" for n in item.notes)]
                lines = []
        blocks.append("\n".join(lines))
    return "\n\n".join(filter(None, blocks)) + "\n"


def _table(table: Table) -> Iterator[str]:
    if table.title:
        yield f"### {_escaped(table.title)}"
        yield ""
    yield _row("<br>".join(_escaped(head) for head in heads if head) for heads in table.heads)
    yield _row("---" if column < table.names else "---:" for column in range(len(table.heads)))
    for row in table.rows:
        yield _row(map(_escaped, row))


def _row(texts: Iterable[str]) -> str:
    return f"| {' | '.join(texts)} |"


def _escaped(text: str) -> str:
    return _SPECIAL.sub(r"\\\1", text)
