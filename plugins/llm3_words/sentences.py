"""What a failure is called when a model reads it.

The three categories are the paper's: the goal configuration is in collision with an object, it has no inverse
kinematics solution, or it is collision-free and reachable (LLM3, section "Motion planning feedback"). The other
kinds of failure are told in the same manner. Depths and other figures are not told, as in the paper.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from llm3.types import ITSELF, Failure, FailureKind

FEASIBLE = "The goal configuration is collision-free and reachable."
FEASIBLE_AT_REST = "It is possible without any motion."


def sentence_of(failure: Failure) -> str:
    """Why the action, or the whole reply, failed: one sentence or several, each with its full stop."""
    match failure.kind:
        case FailureKind.GOAL_IN_COLLISION:
            return _motion(f"The goal configuration is in collision{_with(failure)}.", failure)
        case FailureKind.START_IN_COLLISION:
            return _motion(f"The robot is in collision{_with(failure)} already where this action starts.", failure)
        case FailureKind.UNREACHABLE:
            if failure.detail:
                return _motion(f"No motion leads to the goal configuration.{_involved(failure)}", failure)
            what = "The goal configuration has no inverse kinematics solution: it is out of the robot's reach."
            return what + _involved(failure)
        case FailureKind.NO_PATH:
            what = (
                "The goal configuration is collision-free and reachable, but no collision-free path to it was found "
                "within the planning budget."
            )
            return _motion(what + _involved(failure), failure)
        case FailureKind.PRECONDITION:
            return _told(failure, "The action is not possible in the state that it starts from.")
        case FailureKind.INVALID_ACTION:
            return _told(failure, "This is not a valid action.")
        case FailureKind.UNREADABLE_REPLY:
            return _told(failure, "No plan could be read from the reply.")


def closed(text: str) -> str:
    """The text with a full stop, unless it has an end mark."""
    text = text.strip()
    return text if text.endswith((".", "!", "?")) else f"{text}."


def listed(items: Sequence[str]) -> str:
    """``"a"``, ``"a and b"``, ``"a, b and c"``."""
    return " and ".join([*filter(None, [", ".join(items[:-1])]), *items[-1:]])


def _motion(what: str, failure: Failure) -> str:
    """A motion failure: the category first, then what the domain adds to it."""
    return f"{what} {closed(failure.detail)}" if failure.detail else what


def _told(failure: Failure, otherwise: str) -> str:
    """A failure whose detail says it all."""
    return closed(failure.detail) if failure.detail else otherwise + _involved(failure)


def _with(failure: Failure) -> str:
    objects = _objects(failure)
    return f" with {objects}" if objects else ""


def _involved(failure: Failure) -> str:
    objects = _objects(failure)
    return f" Involved: {objects}." if objects else ""


def _objects(failure: Failure) -> str:
    """The objects to blame, each with the parts that touch it; empty where none is known."""
    names = _once([*failure.objects, *(contact.object for contact in failure.contacts)])
    return listed([_touched(name, failure) for name in names])


def _touched(name: str, failure: Failure) -> str:
    parts = _once(contact.part for contact in failure.contacts if contact.object == name)
    shown = f"the robot {ITSELF}" if name == ITSELF else name
    return f"{shown} (touched by {listed([f'the {part}' for part in parts])})" if parts else shown


def _once(names: Iterable[str]) -> list[str]:
    return list(dict.fromkeys(names))
