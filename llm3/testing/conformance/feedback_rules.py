"""Rules for what a feedback level tells."""

from __future__ import annotations

import re
from collections.abc import Iterator

from llm3.testing.conformance.attempts import UNMET, Told
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.telling import Telling, texts_of
from llm3.testing.conformance.values import programmer_talk
from llm3.types import FailureKind, Feedback

_HOLE = re.compile(r"\bNone\b(?! (?:of|other|at all)\b)|[{}]|%[sdrf]\b|\(\)|\[\]|FailureKind|''|\"\"")


def every_attempt_is_answered(telling: Telling) -> Iterator[Fault]:
    """Of every kind of failure, alone and mid-plan, synthesize makes a Feedback with the attempt's number, or None."""
    for told in telling.told:
        feedback = telling.synthesizer.synthesize(told.attempt)
        if feedback is not None and not isinstance(feedback, Feedback):
            yield Fault(f"{told.name}: synthesize answers {feedback!r}.", "It answers a Feedback, or None.")
            continue
        if feedback is not None and feedback.attempt != told.attempt.number:
            yield Fault(
                f"{told.name}: the feedback is on attempt {feedback.attempt}, and it was attempt "
                f"{told.attempt.number}.",
                "Feedback.attempt is attempt.number.",
            )
        for text in texts_of(feedback) if feedback is not None else ():
            if not isinstance(text, str):
                yield Fault(f"{told.name}: a text of the feedback is {text!r}.", "What has nothing to say is ''.")


def each_action_has_one_remark(telling: Telling) -> Iterator[Fault]:
    """Remarks, where there are any, are one for each action of the plan, in order, with the right verdicts."""
    for told, feedback in telling.answers():
        if not feedback.remarks:
            continue
        plan = told.attempt.proposal.actions if told.attempt.proposal else ()
        wanted = [str(action) for action in plan]
        if [remark.action for remark in feedback.remarks] != wanted:
            yield Fault(
                f"{told.name}: there are {len(feedback.remarks)} remarks on {[r.action for r in feedback.remarks]}, "
                f"and the plan is {wanted}.",
                "One remark for each action of the plan, written as str(action), also of those that were not tried.",
            )
            continue
        tried = ["failed" if outcome.failure else "feasible" for outcome in told.attempt.outcomes]
        verdicts = [*tried, *["not tried"] * (len(plan) - len(tried))]
        if [remark.verdict for remark in feedback.remarks] != verdicts:
            text = f"{told.name}: the verdicts are {[r.verdict for r in feedback.remarks]}, and not {verdicts}."
            yield Fault(text, "An action without an outcome was not tried; one whose outcome has no failure worked.")


def what_is_unreadable_is_told(telling: Telling) -> Iterator[Fault]:
    """A level that tells of failures says why a reply could not be read."""
    tells = any(r.text.strip() for _, feedback in telling.answers() for r in feedback.remarks if r.verdict == "failed")
    for told in telling.told:
        failure = told.failure
        if not tells or failure is None or failure.kind is not FailureKind.UNREADABLE_REPLY:
            continue
        if failure.detail not in telling.summary(told):
            yield Fault(
                f"{told.name}: the summary does not say {failure.detail!r}.",
                "attempt.proposal is None then, and attempt.unreadable.detail is the sentence for the model.",
            )


def no_text_has_a_hole(telling: Telling) -> Iterator[Fault]:
    """No text has a hole where something should stand, a trailing blank, or what is for programmers."""
    for told, feedback in telling.answers():
        for text in texts_of(feedback):
            hole = _HOLE.search(_without_quotes(text, told))
            talk = programmer_talk(text) or (hole.group() if hole else "")
            if talk:
                yield Fault(
                    f"{told.name}: a text holds {talk!r}: {text!r}.",
                    "A failure need not have objects, contacts or a detail: say another sentence without them.",
                )
            elif text != text.strip() or "  " in text or re.search(r" [.,;:]|\.\.$", text):
                yield Fault(
                    f"{told.name}: a text has blanks or stops too many: {text!r}.",
                    "A part that may be empty brings its own blank and its own stop.",
                )


def _without_quotes(text: str, told: Told) -> str:
    """The text without the actions of the plan, which may be quoted as they are written."""
    for action in told.attempt.proposal.actions if told.attempt.proposal else ():
        text = text.replace(str(action), "it")
    return text


def what_is_unmet_is_told_or_not(telling: Telling) -> Iterator[Fault]:
    """All that is missing of the goal is told of every plan that could be read, or nothing of it of any."""
    tells: dict[bool, str] = {}
    for told in telling.told:
        if told.attempt.unreadable:
            continue
        summary = telling.summary(told)
        said = {part: part in summary for part in UNMET}
        if len(set(said.values())) == 2:
            missing = next(part for part in UNMET if not said[part])
            also = next(part for part in UNMET if said[part])
            yield Fault(
                f"{told.name}: of what is unmet {also!r} is told, and {missing!r} is not.",
                "attempt.goal.unmet has several parts: tell all of them.",
            )
            return
        tells.setdefault(any(said.values()), told.name)
    if len(tells) == 2:
        yield Fault(
            f"what is unmet of the goal is told of {tells[True]}, and not of {tells[False]}.",
            "Every part of attempt.goal.unmet belongs into the summary, whatever the plan came to.",
        )


def notes_are_told(telling: Telling) -> Iterator[Fault]:
    """What physics did against the plan is told by every level, of actions that worked and of one that failed."""
    for told in telling.told:
        for note in (note for outcome in told.attempt.outcomes for note in outcome.notes):
            if not any(note in text for text in telling.texts(told)):
                yield Fault(
                    f"{told.name}: the note {note!r} is not told.",
                    "Notes are about the world and not about the planner: Outcome.notes belong into every feedback, "
                    "those of the action that failed, too.",
                )
                return


def the_same_attempt_gets_the_same_words(telling: Telling) -> Iterator[Fault]:
    """The same attempt gets the same feedback, whatever was told in between."""
    first = [telling.synthesizer.synthesize(told.attempt) for told in telling.told]
    for told, before in reversed(list(zip(telling.told, first, strict=True))):
        if telling.synthesizer.synthesize(told.attempt) != before:
            yield Fault(
                f"{told.name}: the second feedback is not the first.", "It must look at nothing but the attempt."
            )
            return


RULES = (
    every_attempt_is_answered,
    each_action_has_one_remark,
    what_is_unreadable_is_told,
    no_text_has_a_hole,
    what_is_unmet_is_told_or_not,
    notes_are_told,
    the_same_attempt_gets_the_same_words,
)
