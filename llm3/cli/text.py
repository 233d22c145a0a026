"""Text that is safe to show in a terminal."""

from __future__ import annotations


def printable(text: str, keep_spaces: bool = False, indent: int = 0) -> str:
    """One line without control characters, whoever wrote it."""
    line = text if keep_spaces else " ".join(text.split())
    return " " * indent + "".join(c if c.isprintable() else " " for c in line).rstrip()
