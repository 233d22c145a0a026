"""An attempt as the report shows it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from llm3.report.cases import Case
from llm3.report.changes import Line, changes
from llm3.report.drawing import Drawing
from llm3.report.story import Turn
from llm3.types import Failure, Feedback, Proposal
from llm3.wording import contact_in_words, failure_in_words


@dataclass(frozen=True)
class Row:
    """An action of a plan."""

    number: int
    action: str
    verdict: str
    """``feasible``, ``failed`` or ``not tried``."""
    text: str
    """Why, and what happened besides."""


@dataclass(frozen=True)
class TurnView:
    """All that is shown of an attempt."""

    turn: Turn
    ending: str
    """Such as ``"failed at action 3"``."""
    reasoning: str
    thoughts: str
    """What the model thought before it answered, where its server tells."""
    rows: tuple[Row, ...]
    unmet: tuple[str, ...]
    repairs: tuple[str, ...]
    """What it took to get and to read the answer."""
    told: tuple[str, ...]
    """What the model is told of what failed, and of the attempt as a whole."""
    changes: tuple[Line, ...]
    """In the prompt, since the last attempt."""
    drawing: Drawing | None
    contacts: tuple[str, ...]
    chapter: int | None
    """Where the replay shows how it failed."""


def turn_view(case: Case, before: Turn | None, drawing: Drawing | None, chapters: Mapping[int, int]) -> TurnView:
    """Put together what is shown of an attempt.

    Args:
        case: The attempt, and the evidence of its failure.
        before: The attempt before it, if there is one.
        drawing: Of where it failed, or of where it led.
        chapters: By the number of an attempt, where the replay shows how it failed.
    """
    turn = case.turn
    proposal = turn.reading if isinstance(turn.reading, Proposal) else None
    completion, ended = turn.completion, turn.ended
    feedback = ended.feedback if ended else None
    return TurnView(
        turn,
        ending(turn),
        proposal.reasoning if proposal else "",
        completion.reasoning if completion else "",
        tuple(_rows(turn)),
        ended.attempt.goal.unmet if ended else (),
        (*(completion.notes if completion else ()), *(proposal.repairs if proposal else ())),
        tuple(_told(feedback)) if feedback else (),
        tuple(changes(before.messages, turn.messages)) if before else (),
        drawing,
        tuple(_seen(case.evidence.failure)) if case.evidence else (),
        chapters.get(turn.number),
    )


def _seen(failure: Failure) -> Iterator[str]:
    yield from map(contact_in_words, failure.contacts)
    touched = {contact.object for contact in failure.contacts}
    yield from (f"{name} is to blame" for name in failure.objects if name not in touched)


def _told(feedback: Feedback) -> Iterator[str]:
    yield from (f"{remark.action}: {remark.text}" for remark in feedback.remarks if remark.verdict == "failed")
    if feedback.summary:
        yield feedback.summary


def ending(turn: Turn) -> str:
    """How an attempt ended, in a few words."""
    if turn.error:
        return "the model did not answer"
    if isinstance(turn.reading, Failure):
        return failure_in_words(turn.reading)
    if turn.failed:
        failure = turn.failed.outcome.failure
        assert failure  # noqa: S101  # that is what failed means
        return f"action {turn.failed.index + 1} failed: {failure_in_words(failure)}"
    if turn.ended is None:
        return "cut off"
    return "the goal is reached" if turn.ended.attempt.goal.achieved else "all actions done, the goal not reached"


def _rows(turn: Turn) -> Iterator[Row]:
    for tried in turn.tried:
        outcome = tried.outcome
        verdict = "failed" if outcome.failure else "feasible"
        texts = [failure_in_words(outcome.failure)] if outcome.failure else ["known before"] * outcome.reused
        yield Row(tried.index + 1, str(outcome.action), verdict, "; ".join([*texts, *outcome.notes]))
    for number, action in enumerate(turn.untried, start=len(turn.tried) + 1):
        yield Row(number, str(action), "not tried", "")
