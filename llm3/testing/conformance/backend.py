"""The check of a model backend."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from llm3.interfaces import LLMBackend
from llm3.jsonio import dumps, loads
from llm3.testing.conformance.answering import REQUESTS, Answering
from llm3.testing.conformance.complaint import Complaint, Report
from llm3.testing.conformance.inspection import Fault, Inspection
from llm3.testing.conformance.values import apart
from llm3.testing.scripted import ScriptedLLM
from llm3.types import Completion, Stats

_COUNTED = {f.name for f in Stats.__dataclass_fields__.values()} - {"seconds"}
SOLVERS = ("llm_calls", "motion_calls", "reused_actions", "unreadable_replies")
"""What the solver counts."""
INSTEAD = "what a model, a server or a file does wrong is a BackendError, with a sentence for the user"


def a_backend_says_what_it_is(answering: Answering) -> Iterator[Fault]:
    """is_language_model is a truth value, notice is a line, and one that is no language model has one."""
    backend = answering.backend
    if not isinstance(backend.is_language_model, bool):
        yield Fault(
            f"is_language_model is {backend.is_language_model!r}.", "It is a property that answers True or False."
        )
    for name in ("notice", "last_words"):
        line = getattr(backend, name)
        if not isinstance(line, str) or "\n" in line:
            yield Fault(
                f"{name} must be one line of text, not {line!r}.", "It is a property, empty for nothing to say."
            )
    if backend.is_language_model is False and not backend.notice:
        yield Fault(
            "the backend is no language model, and its notice does not say so.",
            "Users and records must see what wrote the replies: fill `notice`.",
        )
    if not isinstance(backend.recorded, Mapping):
        yield Fault(f"recorded must be a mapping, not {backend.recorded!r}.", "It names fields of a RunConfig.")


def requests_are_answered(answering: Answering) -> Iterator[Fault]:
    """Messages in, Completion out, with a text that is not empty; no other error than a BackendError, not each time."""
    if not answering.answers and answering.refusals:
        yield Fault(
            f"none of {len(REQUESTS)} requests was answered: {answering.refusals[0]}",
            "The error says why; what does not answer cannot be looked at.",
        )
    for answer in answering.answers:
        if not isinstance(answer, Completion):
            yield Fault(f"complete answers {answer!r:.80}.", "It answers Completion(text), and not the text alone.")
        elif not answer.text.strip():
            yield Fault("a request is answered with an empty text.", "Where there is no answer, raise a BackendError.")
        elif loads(dumps(answer), Completion, "the completion") != answer:
            yield Fault("a completion does not survive being written as JSON.", "Its fields are plain texts and Stats.")


def tokens_are_counted_and_calls_are_not(answering: Answering) -> Iterator[Fault]:
    """What a completion cost is not negative, and holds nothing that the solver counts."""
    for answer in answering.answers:
        if not isinstance(answer, Completion):
            continue
        for name in sorted(_COUNTED):
            number = getattr(answer.stats, name)
            if not isinstance(number, int) or number < 0:
                yield Fault(
                    f"the stats of a completion have {name} = {number!r}.", "Counts are whole numbers from 0 on."
                )
            elif number and name in SOLVERS:
                yield Fault(
                    f"the stats of a completion have {name} = {number}.",
                    "The solver counts calls: leave them out of Completion.stats, or they are counted twice.",
                )


def equal_requests_get_equal_answers(answering: Answering) -> Iterator[Fault]:
    """What is no language model answers equal requests alike, whatever was asked in between."""
    script = isinstance(answering.backend, ScriptedLLM)  # it answers in order, whatever is asked
    if answering.backend.is_language_model or script or len(answering.answers) < len(REQUESTS):
        return
    again = answering.completed(REQUESTS[0])
    if again is not None and again.text != answering.answers[0].text:
        yield Fault(
            f"two equal requests get {apart(answering.answers[0].text, again.text)}.",
            "Draw from np.random.default_rng(request.seed) and from nothing else; where a person types the replies, "
            "that is no fault, and such a run cannot be repeated.",
        )


def chance_comes_from_the_request(answering: Answering) -> Iterator[Fault]:
    """No request draws from the generators that everybody shares, or seeds them."""
    if answering.drew:
        yield Fault(
            "a request draws from the global generator of random or numpy, or seeds it.",
            "Draw from np.random.default_rng(request.seed), or from a random.Random of your own.",
        )


def nothing_is_printed(answering: Answering) -> Iterator[Fault]:
    """No request writes to standard output, where a command's results go."""
    if answering.printed:
        yield Fault(
            f"a request prints {answering.printed[:60]!r} on standard output.",
            "Results go there: use notice, last_words or Completion.notes, and stderr for a question to a person.",
        )


def closing_it_twice_does_no_harm(answering: Answering) -> Iterator[Fault]:
    """A closed backend can be closed again."""
    answering.backend.close()
    answering.backend.close()
    yield from ()


RULES = (
    a_backend_says_what_it_is,
    requests_are_answered,
    tokens_are_counted_and_calls_are_not,
    equal_requests_get_equal_answers,
    chance_comes_from_the_request,
    nothing_is_printed,
    closing_it_twice_does_no_harm,
)


def check_backend(backend: LLMBackend) -> tuple[Complaint, ...]:
    """Look for faults in a model backend, which is asked two or three tiny questions, and then closed."""
    return examine_backend(backend).complaints


def examine_backend(backend: LLMBackend) -> Report:
    """Like :func:`check_backend`, with the remarks and with what was looked at."""
    inspection = Inspection(INSTEAD)
    answering = Answering(backend)
    inspection.apply(RULES, answering)
    for refusal in answering.refusals if answering.answers else ():
        inspection.remark(f"It gave no answer, so that could not be looked at: {refusal}")
    return inspection.report
