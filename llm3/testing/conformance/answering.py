"""A backend at work on tiny requests."""

from __future__ import annotations

import io
import sys
from contextlib import redirect_stdout

from llm3.errors import BackendError
from llm3.interfaces import LLMBackend
from llm3.parsing import reply_schema
from llm3.testing.conformance.attempts import SKELETON, context, trace
from llm3.testing.conformance.purity_rules import global_generators
from llm3.types import Completion, Context, Message, Request


def _request(seed: int, of: Context) -> Request:
    """A question such as the loop asks; a model may answer it with a short text."""
    messages = (
        Message("system", "You plan for a robot."),
        Message("user", 'Answer with this JSON object and nothing else: {"Reasoning": "", "Full Plan": []}'),
    )
    return Request(messages, of, seed, reply_schema(of.actions, of.objects, of.skeleton), 60.0)


REQUESTS = (_request(1, context(skeleton=SKELETON)), _request(2, context(trace(), SKELETON)))


class Overheard(io.StringIO):
    """Standard output while a backend answers: kept, and passed on to where it spoils no results."""

    def write(self, text: str) -> int:
        """Keep it, and pass it on."""
        sys.stderr.write(text)
        return super().write(text)


class Answering:
    """A backend at work."""

    def __init__(self, backend: LLMBackend) -> None:
        self.backend = backend
        self.refusals: list[BackendError] = []
        """Why there was no answer."""
        self.printed = ""
        """What came on standard output in place of results."""
        self.drew = False
        """Whether the generators that everybody shares were not left alone."""
        self._answers: list[Completion] | None = None

    def completed(self, request: Request) -> Completion | None:
        """The answer; None if there is none to be had."""
        before, output = global_generators(), Overheard()
        try:
            with redirect_stdout(output):
                return self.backend.complete(request)
        except BackendError as error:
            self.refusals.append(error)
            return None
        finally:
            self.printed += output.getvalue()
            self.drew = self.drew or global_generators() != before

    @property
    def answers(self) -> list[Completion]:
        """To each request, asked once: answers may cost something."""
        if self._answers is None:
            self._answers = []
            found = [self.completed(request) for request in REQUESTS]
            self._answers = [answer for answer in found if answer is not None]
        return self._answers
