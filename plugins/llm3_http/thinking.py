"""What a model thought, apart from what it answers."""

from __future__ import annotations


def apart(text: str) -> tuple[str, str]:
    """What stands in a ``<think>…</think>`` block at the beginning, and the answer after it.

    Chat templates that put the opening tag into the prompt leave only the closing one; a reply that ends while the
    model still thinks has no answer.
    """
    thought, closing, answer = text.partition("</think>")
    opened = thought.lstrip().startswith("<think>")
    if opened or (closing and "<think>" not in thought):
        return thought.strip().removeprefix("<think>").strip(), answer.lstrip()
    return "", text
