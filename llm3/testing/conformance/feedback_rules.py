"""Rules for what a feedback level tells."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import get_args

from llm3.testing.conformance.attempts import BLAMED, NOTE, UNMET
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.telling import Telling, texts_of
from llm3.testing.conformance.values import programmer_talk
from llm3.types import FailureKind, Feedback, Remark

_HOLE = re.compile(r"\bNone\b|[{}]|%[sdrf]\b|\(\)|\[\]|FailureKind|''|\"\"")
VERDICTS = get_args(Remark.__annotations__["verdict"]) or ("feasible", "failed", "not tried")


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


def no_kind_of_failure_is_left_out(telling: Telling) -> Iterator[Fault]:
    """A level that has words for some failures of motions, or for some others, has them for all of those."""
    words: dict[bool, dict[FailureKind, bool]] = {True: {}, False: {}}
    for told, feedback in telling.answers():
        failed = [remark.text for remark in feedback.remarks if remark.verdict == "failed"]
        if told.failure is not None and failed:
            of_kind = words[told.failure.kind.is_motion]
            of_kind[told.failure.kind] = of_kind.get(told.failure.kind, True) and bool(failed[-1].strip(" ."))
    for of_kind in words.values():
        tells = [kind.value for kind, tells in of_kind.items() if tells]
        for kind in (kind for kind, tells in of_kind.items() if not tells and any(of_kind.values())):
            yield Fault(
                f"it tells nothing of the kind {kind.value!r}, though it tells of {', '.join(tells)}.",
                "There is a sentence for each FailureKind, also for one that is added later.",
            )


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
        said = all(part in telling.summary(told) for part in UNMET)
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
        if not any(NOTE in text for text in telling.texts(told)):
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
    no_kind_of_failure_is_left_out,
    what_is_unreadable_is_told,
    no_text_has_a_hole,
    what_is_unmet_is_told_or_not,
    notes_are_told,
    the_same_attempt_gets_the_same_words,
)
