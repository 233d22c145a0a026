"""The check of a feedback level."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import get_args

from llm3.interfaces import FeedbackSynthesizer
from llm3.testing.conformance.attempts import BLAMED, NOTE, UNMET, Told, attempts
from llm3.testing.conformance.complaint import Complaint, Report
from llm3.testing.conformance.inspection import Fault, Inspection
from llm3.testing.conformance.values import programmer_talk
from llm3.types import FailureKind, Feedback, Remark

_HOLE = re.compile(r"\bNone\b|[{}]|%[sdrf]\b|\(\)|\[\]|FailureKind|''|\"\"")
VERDICTS = get_args(Remark.__annotations__["verdict"]) or ("feasible", "failed", "not tried")


class Telling:
    """A feedback level at work."""

    def __init__(self, synthesizer: FeedbackSynthesizer) -> None:
        self.synthesizer, self.told = synthesizer, attempts()

    def answers(self) -> Iterator[tuple[Told, Feedback]]:
        """What it tells, where it tells anything."""
        for told in self.told:
            feedback = self.synthesizer.synthesize(told.attempt)
            if isinstance(feedback, Feedback):
                yield told, feedback


def every_attempt_is_answered(telling: Telling) -> Iterator[Fault]:
    """Of every kind of failure, alone and mid-plan, synthesize makes a Feedback with the attempt's number, or None."""
    for told in telling.told:
        feedback = telling.synthesizer.synthesize(told.attempt)
        if feedback is not None and not isinstance(feedback, Feedback):
            yield Fault(f"{told.name}: synthesize answers {feedback!r}.", "It answers a Feedback, or None.")
        elif feedback is not None and feedback.attempt != told.attempt.number:
            yield Fault(
                f"{told.name}: the feedback is on attempt {feedback.attempt}, and it was attempt "
                f"{told.attempt.number}.",
                "Feedback.attempt is attempt.number.",
            )


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


def failures_name_their_objects(telling: Telling) -> Iterator[Fault]:
    """Where the text on a failure says anything, it names the objects of the failure."""
    for told, feedback in telling.answers():
        failure = told.failure
        if failure is None or not (failure.objects or BLAMED in failure.detail):
            continue
        texts = [remark.text for remark in feedback.remarks if remark.verdict == "failed" and remark.text.strip()]
        for text in texts:
            if BLAMED not in text:
                yield Fault(
                    f"{told.name}: {text!r} does not name {BLAMED}, which is to blame.",
                    f"Name Failure.objects, and tell its detail, for the kind {failure.kind.name}, too; a level that "
                    "tells less leaves the text empty.",
                )


def what_is_unreadable_is_told(telling: Telling) -> Iterator[Fault]:
    """A level that tells of failures says why a reply could not be read."""
    tells = any(r.text.strip() for _, feedback in telling.answers() for r in feedback.remarks if r.verdict == "failed")
    for told in telling.told:
        if tells and told.failure is not None and told.failure.kind is FailureKind.UNREADABLE_REPLY:
            feedback = telling.synthesizer.synthesize(told.attempt)
            if not isinstance(feedback, Feedback) or told.failure.detail not in feedback.summary:
                yield Fault(
                    f"{told.name}: the summary does not say {told.failure.detail!r}.",
                    "attempt.proposal is None then, and attempt.unreadable.detail is the sentence for the model.",
                )


def no_text_has_a_hole(telling: Telling) -> Iterator[Fault]:
    """No text has a hole where something should stand, a trailing blank, or what is for programmers."""
    for told, feedback in telling.answers():
        for text in (feedback.summary, *(remark.text for remark in feedback.remarks)):
            hole = _HOLE.search(text)
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


def what_is_unmet_is_told_or_not(telling: Telling) -> Iterator[Fault]:
    """What is missing of the goal is told of every plan that could be read, or of none."""
    tells: dict[bool, str] = {}
    for told in telling.told:
        if told.attempt.unreadable:
            continue
        feedback = telling.synthesizer.synthesize(told.attempt)
        said = isinstance(feedback, Feedback) and all(part in feedback.summary for part in UNMET)
        tells.setdefault(said, told.name)
    if len(tells) == 2:
        yield Fault(
            f"what is unmet of the goal is told of {tells[True]}, and not of {tells[False]}.",
            "Every part of attempt.goal.unmet belongs into the summary, whatever the plan came to.",
        )


def notes_are_told(telling: Telling) -> Iterator[Fault]:
    """What physics did against the plan is told by every level."""
    for told in telling.told:
        if not any(outcome.notes for outcome in told.attempt.outcomes):
            continue
        feedback = telling.synthesizer.synthesize(told.attempt)
        texts = (feedback.summary, *(r.text for r in feedback.remarks)) if isinstance(feedback, Feedback) else ()
        if not any(NOTE in text for text in texts):
            yield Fault(
                f"{told.name}: the note {NOTE!r} is not told.",
                "Notes are about the world and not about the planner: Outcome.notes belong into every feedback.",
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
    failures_name_their_objects,
    what_is_unreadable_is_told,
    no_text_has_a_hole,
    what_is_unmet_is_told_or_not,
    notes_are_told,
    the_same_attempt_gets_the_same_words,
)


def check_feedback(synthesizer: FeedbackSynthesizer) -> tuple[Complaint, ...]:
    """Look for faults in a feedback level, on attempts that fail in every way."""
    return examine_feedback(synthesizer).complaints


def examine_feedback(synthesizer: FeedbackSynthesizer) -> Report:
    """Like :func:`check_feedback`, with what was looked at."""
    inspection = Inspection()
    inspection.apply(RULES, Telling(synthesizer))
    return inspection.report
