"""What is to be seen of a failure: where the robot would have been, and what touches what there."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from llm3.types import ITSELF, ActionTried, Contact, EventKind, Failure, Moment, PlannedAction, moment_of
from llm3.wording import contact_in_words


@dataclass(frozen=True)
class Touch:
    """Two things that touch."""

    movers: tuple[str, ...]
    """What moves, by the names that a scenery has for it: a link, something held, or all links where none is told."""
    other: str
    """What it meets, as the failure names it; a link where the robot meets itself."""
    contact: Contact
    """As the planner told it."""


@dataclass(frozen=True)
class Evidence:
    """The moment that a failure is about, as far as it tells one."""

    failure: Failure
    moment: Moment
    """The world as it was, and the robot where it would have failed; where it stood if no configuration is told."""
    touches: tuple[Touch, ...]
    """What touches what there, the deepest first; empty where nothing does."""


def told(touch: Touch) -> str:
    """Such as ``held blue_box touches red_box, 3.2 mm deep``."""
    return contact_in_words(touch.contact)


def touching(touches: Iterable[Touch]) -> frozenset[str]:
    """The names of everything that touches something."""
    return frozenset(name for touch in touches for name in (*touch.movers, touch.other))


def evidence(tried: ActionTried, before: Iterable[PlannedAction], robot: Sequence[str]) -> Evidence | None:
    """What is to be seen of an action that failed; None of one that did not.

    Args:
        tried: The action.
        before: The actions of the same attempt that were carried out before it.
        robot: The names of the robot's parts.
    """
    failure = tried.outcome.failure
    if failure is None:
        return None
    moment = moment_of(tried.before, _opening(before) if tried.before.held else None)
    if failure.configuration:
        moment = replace(moment, configuration=failure.configuration)
    things = (*moment.poses, *((moment.held.object,) if moment.held else ()))
    touches = (Touch(_movers(contact, things, robot), _other(contact), contact) for contact in failure.contacts)
    return Evidence(failure, moment, tuple(touches))


def _movers(contact: Contact, things: Sequence[str], robot: Sequence[str]) -> tuple[str, ...]:
    """What a contact calls a part: a link, the robot as a whole, or a thing after a word such as "held"."""
    if contact.link:
        return (contact.link,)
    for name in sorted((*things, *robot), key=len, reverse=True):
        if contact.part == name or contact.part.endswith(f" {name}"):
            return (name,)
    return tuple(robot)


def _other(contact: Contact) -> str:
    return contact.other_link if contact.object == ITSELF else contact.object


def _opening(steps: Iterable[PlannedAction]) -> float | None:
    """How far the fingers are apart after some actions; None where none of them tells."""
    events = [event for step in steps for event in step.motion.events if event.kind is EventKind.GRIPPER]
    return events[-1].opening if events else None
