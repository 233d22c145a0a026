"""Buttons for a replay that can be reached by keyboard and have names, and messages by which another page plays it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from importlib.resources import files

from llm3.jsonio import dumps


@dataclass(frozen=True)
class Mark:
    """Where a chapter is in a replay."""

    title: str
    note: str
    """What to say while it is shown."""
    time: float
    """Of its beginning, in seconds from the start of the replay."""
    end: float


def with_controls(page: str, title: str, chapters: Sequence[Mark]) -> str:
    """A page that viser exported, with a title, and `controls.js`, which does the rest.

    Args:
        page: The whole page.
        title: What it is called.
        chapters: At least one.
    """
    here = files(__package__)
    told = dumps(chapters).replace("<", "\\u003c")  # nothing in a title ends the script
    script = here.joinpath("controls.js").read_text(encoding="utf-8")
    style = here.joinpath("controls.css").read_text(encoding="utf-8")
    ours = (
        f"<title>{escape(title)}</title>\n<style>{style}</style>\n<script>const CHAPTERS = {told};\n{script}</script>"
    )
    start, end = page.index("<title>"), page.index("</title>") + len("</title>")
    return page[:start] + ours + page[end:]
