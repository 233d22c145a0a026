"""Rules for what a feedback level tells of an action that failed."""

from __future__ import annotations

import re
from collections.abc import Iterator

from llm3.testing.conformance.attempts import ALSO_BLAMED, BLAMED, HELD
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.telling import BETWEEN, Telling
from llm3.types import FailureKind

_NAMES = f"(?:{BLAMED}|{ALSO_BLAMED})"
_HELD_AS_OBSTACLE = re.compile(
    rf"{_NAMES}(?:,| and|, and) (?:the )?{HELD}(?=[.,;:)]|$)"
    rf"|(?:with|of|blame:?|involved:?) (?:the )?{HELD}(?:,| and) {_NAMES}",
    re.IGNORECASE,
)
"""Where it stands in a list of obstacles, and not as what touches them."""


def failures_name_their_objects(telling: Telling) -> Iterator[Fault]:
    """Where the text on a failure says anything, it names all objects of the failure, and the held one as none."""
    for told, failure, _, text in telling.failures():
        for name in failure.objects if text else ():
            if name not in text:
                yield Fault(
                    f"{told.name}: {text!r} does not name {name}, which is to blame.",
                    f"Name all of Failure.objects, for the kind {failure.kind.name}, too; a level that tells less "
                    "leaves the text empty.",
                )
        if _HELD_AS_OBSTACLE.search(text):
            yield Fault(
                f"{told.name}: {text!r} blames {HELD!r}, which is what the robot holds.",
                "Contact.part is of the robot's side; what is in the way is Contact.object.",
            )


def details_are_told(telling: Telling) -> Iterator[Fault]:
    """Where the text on a failure says anything, the failure's detail stands in it."""
    for told, failure, _, text in telling.failures():
        if text and _plain(failure.detail) not in _plain(text):
            yield Fault(
                f"{told.name}: {text!r} does not say {failure.detail!r}.",
                "Failure.detail is the domain's sentence for the model, of motions, too; a level that tells less "
                "leaves the text empty.",
            )
            return


def remarks_say_their_kind(telling: Telling) -> Iterator[Fault]:
    """Remark.kind is the failure's where the text tells which kind it is, and None where it tells nothing."""
    kinds = telling.told_kinds()
    for told, failure, remark, text in telling.failures():
        if remark.kind not in (None, failure.kind):
            yield Fault(
                f"{told.name}: the kind of the remark is {_named(remark.kind)}, and the failure's is "
                f"{failure.kind.value!r}.",
                "Remark.kind is outcome.failure.kind, or None.",
            )
        elif remark.kind is None and text and failure.kind in kinds:
            yield Fault(
                f"{told.name}: the text tells that it is {failure.kind.value!r}, and the remark has no kind.",
                "Give Remark(…, kind=outcome.failure.kind): stand-ins cannot read prose.",
            )
        elif remark.kind is not None and not text:
            yield Fault(
                f"{told.name}: the remark has the kind {failure.kind.value!r}, and its text tells nothing.",
                "Leave Remark.kind out where the text does not tell it: stand-ins are told what a model is told.",
            )
    for told, feedback in telling.answers():
        for remark in feedback.remarks:
            if remark.kind is not None and remark.verdict != "failed":
                yield Fault(
                    f"{told.name}: the remark on an action that is {remark.verdict!r} has the kind "
                    f"{_named(remark.kind)}.",
                    "Only what failed has a kind of failure.",
                )


def no_kind_of_failure_is_left_out(telling: Telling) -> Iterator[Fault]:
    """A level that has words for some failures of motions, or for some others, has them for all of those."""
    words: dict[bool, dict[FailureKind, bool]] = {True: {}, False: {}}
    for _, failure, _, text in telling.failures():
        of_kind = words[failure.kind.is_motion]
        of_kind[failure.kind] = of_kind.get(failure.kind, True) and bool(text)
    for of_kind in words.values():
        tells = [kind.value for kind, tells in of_kind.items() if tells]
        for kind in (kind for kind, tells in of_kind.items() if not tells and any(of_kind.values())):
            yield Fault(
                f"it tells nothing of the kind {kind.value!r}, though it tells of {', '.join(tells)}.",
                "There is a sentence for each FailureKind, also for one that is added later.",
            )


def _named(kind: object) -> str:
    return repr(kind.value if isinstance(kind, FailureKind) else kind)


def _plain(text: str) -> str:
    """A sentence in comparable form, however it was begun and ended."""
    return " ".join(text.casefold().split()).rstrip(BETWEEN)


RULES = (
    failures_name_their_objects,
    details_are_told,
    remarks_say_their_kind,
    no_kind_of_failure_is_left_out,
)
