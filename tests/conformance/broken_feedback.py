"""Feedback levels with one fault each."""

from __future__ import annotations

from dataclasses import replace
from itertools import count

from planted import Planted

from llm3 import FeedbackSynthesizer
from llm3.types import FailureKind, Feedback, Remark


class Plain(FeedbackSynthesizer):
    """Tells of everything, in few words."""

    def synthesize(self, attempt):
        if attempt.unreadable:
            return Feedback(attempt.number, summary=f"{attempt.unreadable.detail or 'no plan can be read'}.")
        actions = attempt.proposal.actions
        remarks = [self.remark(outcome) for outcome in attempt.outcomes]
        remarks += [Remark(str(action), "not tried") for action in actions[len(remarks) :]]
        return Feedback(attempt.number, tuple(remarks), self.summary(attempt))

    def remark(self, outcome):
        why = [self.why(outcome.failure)] if outcome.failure else []
        text = " ".join(f"{part}." for part in (*why, *outcome.notes))
        kind = outcome.failure.kind if outcome.failure else None
        return Remark(str(outcome.action), "failed" if outcome.failure else "feasible", text, kind)

    def why(self, failure):
        named = f", because of {', '.join(failure.objects)}" if failure.objects else ""
        return f"{failure.detail or failure.kind.value}{named}"

    def summary(self, attempt):
        return f"Missing: {'; '.join(attempt.goal.unmet)}."


def a_level(**parts):
    return type("Level", (Plain,), parts)()


def told_with(change):
    """A level whose feedback is changed before it is told."""
    return a_level(synthesize=lambda self, attempt: change(Plain.synthesize(self, attempt)))


def shuffled():
    calls = count()
    return told_with(lambda feedback: replace(feedback, summary=f"{feedback.summary} Take {next(calls)}."))


def without_words_for(kind):
    """A level that says nothing of one kind of failure."""

    def remark(self, outcome):
        found = Plain.remark(self, outcome)
        left_out = outcome.failure is not None and outcome.failure.kind is kind
        return replace(found, text=" ".join(f"{note}." for note in outcome.notes), kind=None) if left_out else found

    return a_level(remark=remark)


def remarks_with(change):
    """A level whose remarks are changed, given the outcome."""
    return a_level(remark=lambda self, outcome: change(Plain.remark(self, outcome), outcome))


def quoting():
    """Writes the action into the text, and talks of none of the objects."""

    def why(self, failure):
        return f"None of the places is free: {Plain.why(self, failure)}"

    def remark(self, outcome):
        found = Plain.remark(self, outcome)
        return replace(found, text=f"{outcome.action} is said to be {found.verdict}. {found.text}".strip())

    return a_level(why=why, remark=remark)


def verdict_alone():
    """Says in words that a motion failed, and not why."""

    def remark(self, outcome):
        if outcome.failure is None or not outcome.failure.kind.is_motion:
            return Plain.remark(self, outcome)
        said = f"{outcome.action} failed", *outcome.notes
        return Remark(str(outcome.action), "failed", " ".join(f"{part}." for part in said))

    return a_level(remark=remark)


def first_object(self, failure):
    return Plain.why(self, replace(failure, objects=failure.objects[:1]))


def with_the_parts(self, failure):
    """Takes what touches for what is touched."""
    parts = tuple(contact.part for contact in failure.contacts)
    return Plain.why(self, replace(failure, objects=(*failure.objects, *parts[:1])))


def without_detail(self, failure):
    return Plain.why(self, replace(failure, detail="") if failure.kind.is_motion else failure)


KNOWN = {FailureKind.PRECONDITION: "it is not possible here"}
FAULTS: dict[str, Planted] = {
    "words alone": Planted(
        told_with(lambda feedback: feedback.summary),
        "every attempt is answered",
        "a plan that falls short: synthesize answers 'Missing: green_cup is not on oak_shelf; …",
        "a Feedback, or None",
    ),
    "another attempt": Planted(
        told_with(lambda feedback: replace(feedback, attempt=1)),
        "every attempt is answered",
        "a plan that falls short: the feedback is on attempt 1, and it was attempt 3.",
        "attempt.number",
    ),
    "only what was tried": Planted(
        told_with(lambda f: replace(f, remarks=tuple(r for r in f.remarks if r.verdict != "not tried"))),
        "each action has one remark",
        "unreachable, mid-plan: there are 3 remarks on […], and the plan is […].",
        "not tried",
    ),
    "all failed": Planted(
        told_with(lambda f: replace(f, remarks=tuple(replace(r, verdict="failed") for r in f.remarks))),
        "each action has one remark",
        "a plan that falls short: the verdicts are ['failed', 'failed'], and not ['feasible', 'feasible'].",
        "An action without an outcome was not tried",
    ),
    "no names": Planted(
        a_level(why=lambda self, failure: failure.kind.value),
        "failures name their objects",
        "unreachable, alone: 'unreachable' does not name oak_shelf, which is to blame.",
        "Failure.objects",
    ),
    "only the first object": Planted(
        a_level(why=first_object),
        "failures name their objects",
        "unreachable, alone: 'unreachable, because of oak_shelf' does not name tin_lamp, which is to blame.",
        "all of Failure.objects",
    ),
    "what is held as an obstacle": Planted(
        a_level(why=with_the_parts),
        "failures name their objects",
        "goal in collision, alone: 'goal in collision, because of oak_shelf, tin_lamp, held green_cup' blames 'held "
        "green_cup', which is what the robot holds.",
        "Contact.object",
    ),
    "no detail": Planted(
        a_level(why=without_detail),
        "details are told",
        "unreachable, with a detail: 'unreachable' does not say 'the lid of the pot is open too wide'.",
        "Failure.detail",
    ),
    "no kind": Planted(
        remarks_with(lambda remark, outcome: replace(remark, kind=None)),
        "remarks say their kind",
        "unreachable, alone: the text tells that it is 'unreachable', and the remark has no kind.",
        "cannot read prose",
    ),
    "another kind": Planted(
        remarks_with(lambda remark, outcome: replace(remark, kind=remark.kind and FailureKind.NO_PATH)),
        "remarks say their kind",
        "unreachable, alone: the kind of the remark is 'no path within budget', and the failure's is 'unreachable'.",
        "outcome.failure.kind",
    ),
    "a kind that the text does not tell": Planted(
        remarks_with(lambda remark, outcome: replace(remark, text=" ".join(f"{note}." for note in outcome.notes))),
        "remarks say their kind",
        "unreachable, alone: the remark has the kind 'unreachable', and its text tells nothing.",
        "stand-ins are told what a model is told",
    ),
    "a kind of what worked": Planted(
        remarks_with(lambda remark, outcome: replace(remark, kind=remark.kind or FailureKind.PRECONDITION)),
        "remarks say their kind",
        "a plan that falls short: the remark on an action that is 'feasible' has the kind 'precondition'.",
        "Only what failed",
    ),
    "only the first of what is unmet": Planted(
        a_level(summary=lambda self, attempt: f"Missing: {attempt.goal.unmet[0]}."),
        "what is unmet is told or not",
        "a plan that falls short: of what is unmet 'green_cup is not on oak_shelf' is told, and 'the hand of the robot "
        "is not empty' is not.",
        "tell all of them",
    ),
    "no notes of what failed": Planted(
        a_level(
            remark=lambda self, outcome: Plain.remark(self, replace(outcome, notes=()) if outcome.failure else outcome)
        ),
        "notes are told",
        "unreachable, mid-plan: the note 'tin_kettle toppled' is not told.",
        "the action that failed",
    ),
    "forgets a kind": Planted(
        a_level(
            why=lambda self, failure: (
                "no way was found" if failure.kind is FailureKind.NO_PATH else Plain.why(self, failure)
            )
        ),
        "failures name their objects",
        "no path within budget, alone: 'no way was found' does not name oak_shelf, which is to blame.",
        "NO_PATH",
    ),
    "no words for a kind of motion failure": Planted(
        without_words_for(FailureKind.NO_PATH),
        "no kind of failure is left out",
        "it tells nothing of the kind 'no path within budget', though it tells of unreachable, goal in collision, "
        "start in collision.",
        "a sentence for each FailureKind",
    ),
    "no words for a kind that is no motion failure": Planted(
        without_words_for(FailureKind.INVALID_ACTION),
        "no kind of failure is left out",
        "it tells nothing of the kind 'invalid action', though it tells of precondition.",
        "a sentence for each FailureKind",
    ),
    "knows the kinds by a table": Planted(
        a_level(why=lambda self, failure: KNOWN[failure.kind]),
        "nothing is raised",
        "Level.synthesize raised KeyError: <FailureKind.UNREACHABLE: 'unreachable'> (broken_feedback.py:…).",
        "there are words for every attempt, also for one without a plan, and for a failure of every kind",
    ),
    "no text": Planted(
        a_level(remark=lambda self, outcome: replace(Plain.remark(self, outcome), text=None)),
        "every attempt is answered",
        "a plan that falls short: a text of the feedback is None.",
        "What has nothing to say is ''.",
    ),
    "unreadable without a reason": Planted(
        a_level(
            synthesize=lambda self, attempt: (
                Feedback(attempt.number, summary="Try again.")
                if attempt.unreadable
                else Plain.synthesize(self, attempt)
            )
        ),
        "what is unreadable is told",
        "unreadable reply: the summary does not say 'no complete plan can be read from the reply'.",
        "attempt.unreadable.detail",
    ),
    "a hole": Planted(
        a_level(why=lambda self, failure: f"in collision with {failure.objects[0] if failure.objects else None}"),
        "no text has a hole",
        "unreachable, without evidence: a text holds 'None': 'in collision with None.'.",
        "need not have objects",
    ),
    "a template": Planted(
        a_level(summary=lambda self, attempt: "Missing: {unmet}."),
        "no text has a hole",
        "a plan that falls short: a text holds '{': 'Missing: {unmet}.'.",
        "another sentence",
    ),
    "trailing blank": Planted(
        a_level(summary=lambda self, attempt: f"{Plain.summary(self, attempt)} "),
        "no text has a hole",
        "a plan that falls short: a text has blanks or stops too many: 'Missing: …. '.",
        "its own blank",
    ),
    "unmet only at times": Planted(
        a_level(summary=lambda self, attempt: "" if attempt.failure else Plain.summary(self, attempt)),
        "what is unmet is told or not",
        "what is unmet of the goal is told of a plan that falls short, and not of unreachable, alone.",
        "attempt.goal.unmet",
    ),
    "no notes": Planted(
        a_level(remark=lambda self, outcome: Plain.remark(self, replace(outcome, notes=()))),
        "notes are told",
        "unreachable, mid-plan: the note 'green_cup slid 12 mm' is not told.",
        "every feedback",
    ),
    "other words each time": Planted(
        shuffled(),
        "the same attempt gets the same words",
        "…: the second feedback is not the first.",
        "nothing but the attempt",
    ),
    "raises without a plan": Planted(
        a_level(synthesize=lambda self, attempt: Feedback(attempt.number, summary=str(attempt.proposal.actions))),
        "nothing is raised",
        "Level.<lambda> raised AttributeError: 'NoneType' object has no attribute 'actions' (broken_feedback.py:…).",
        "ends a run",
    ),
}
