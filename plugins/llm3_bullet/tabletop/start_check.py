"""What is wrong where the arm starts, and what to do about it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from llm3.types import ITSELF, Contact


def start_fault(contacts: Sequence[Contact], boxes: Iterable[str]) -> str:
    """A sentence for who made the problem, or the robot; empty without contacts.

    Args:
        contacts: Of the arm at home.
        boxes: The names of what can be put elsewhere.
    """
    movable = set(boxes)
    among_boxes = dict.fromkeys(contact.object for contact in contacts if contact.object in movable)
    itself = dict.fromkeys(f"{c.link} and {c.other_link}" for c in contacts if c.object == ITSELF)
    fixed = dict.fromkeys(f"{c.link} and {c.object}" for c in contacts if c.object not in {*movable, ITSELF})
    if among_boxes:
        return f"the arm touches {', '.join(among_boxes)} where it starts: move it farther from the arm."
    if itself:
        return (
            f"links of the arm touch each other where it starts: {'; '.join(itself)}. Change the robot's home, or name "
            "pairs that always touch in its may_touch."
        )
    if fixed:
        return (
            f"the arm touches what stands around it where it starts: {'; '.join(fixed)}. Change the robot's home or "
            "base, or name links that it stands on in its mounted_links."
        )
    return ""
