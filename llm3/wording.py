"""Words for numbers, failures and endings."""

from __future__ import annotations

from collections.abc import Mapping

from llm3.types import Contact, Failure, FrozenDict

ENDINGS: Mapping[str, str] = FrozenDict(
    {
        "calls": "the budget of model calls is used up",
        "tokens": "the budget of tokens is used up",
        "seconds": "the budget of seconds is used up",
        "motions": "the budget of motion calls is used up",
        "attempts": "the search made very many attempts with hardly any motion",
        "exhausted": "everything that can be done was tried, and nothing reached the goal",
    }
)
"""Why a run ended, by `Result.stop`, where it does not go without saying."""


def counted(number: int, noun: str) -> str:
    """A number and what it counts, such as ``1 run`` or ``1,200 runs``."""
    return f"{number:,} {noun}{'s' * (number != 1)}"


def failure_in_words(failure: Failure) -> str:
    """Such as ``goal in collision (red_box)``, with the detail where there is one."""
    objects = f" ({', '.join(failure.objects)})" if failure.objects else ""
    return f"{failure.kind.value}{objects}{f': {failure.detail}' if failure.detail else ''}"


def contact_in_words(contact: Contact) -> str:
    """Such as ``held blue_box touches red_box, 3.2 mm deep``."""
    part = f"{contact.part} ({contact.link})" if contact.link else contact.part
    other = f"{contact.object} ({contact.other_link})" if contact.other_link else contact.object
    if contact.depth < 0:
        return f"{part} comes within {-1000 * contact.depth:.1f} mm of {other}"
    return f"{part} touches {other}, {1000 * contact.depth:.1f} mm deep"
