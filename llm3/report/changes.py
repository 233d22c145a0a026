"""What is new in a prompt since the last one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from typing import Literal

from llm3.types import Message

CONTEXT = 1
"""How many lines that stayed are shown around those that changed."""

MANY = 2000
"""Lines of two prompts that are more than can be compared in full."""


@dataclass(frozen=True)
class Line:
    """A line of a prompt, or where some are left out."""

    kind: Literal["kept", "added", "removed", "left out"]
    text: str = ""


def changes(before: Sequence[Message], after: Sequence[Message]) -> Iterator[Line]:
    """The lines that came and went, in order, with a little of what stands around them; none if nothing changed.

    Args:
        before: The last prompt.
        after: This one.
    """
    old, new = list(_lines(before)), list(_lines(after))
    many = len(old) + len(new) > MANY  # where lines that repeat are taken for no match, which is coarser, and not slow
    matcher = SequenceMatcher(None, old, new, autojunk=many)
    if matcher.ratio() == 1:
        return
    for number, group in enumerate(matcher.get_grouped_opcodes(CONTEXT)):
        if number:
            yield Line("left out")
        for kind, first, last, begin, end in group:
            if kind == "equal":
                yield from (Line("kept", text) for text in new[begin:end])
            else:
                yield from (Line("removed", text) for text in old[first:last])
                yield from (Line("added", text) for text in new[begin:end])


def _lines(messages: Sequence[Message]) -> Iterator[str]:
    for message in messages:
        yield f"[{message.role}]"
        yield from message.content.splitlines()
