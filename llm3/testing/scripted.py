"""A fake model that says what a test tells it to say."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

import numpy as np

from llm3.errors import BackendError
from llm3.interfaces import LLMBackend, StandIn
from llm3.types import Completion, Request

Reply = str | Completion | BaseException
Script = Iterable[Reply] | Callable[[Request], Reply]


class ScriptedLLM(LLMBackend):
    """Answers from a script: a list, a generator, or a function of the request.

    An exception in the script, a KeyboardInterrupt for instance, is raised instead of answered. Every request is kept
    in `requests`, so that a test can look at the prompts that the loop wrote.
    """

    def __init__(self, script: Script) -> None:
        """Take the replies.

        Raises:
            TypeError: The script is one text; its characters would be the replies.
        """
        if isinstance(script, str):
            raise TypeError("a script is a list of replies, not one text: write ScriptedLLM([text])")
        self.requests: list[Request] = []
        self._function = script if callable(script) else None
        self._replies: Iterator[Reply] = iter(()) if callable(script) else iter(script)

    @property
    def is_language_model(self) -> bool:
        """It is none."""
        return False

    @property
    def notice(self) -> str:
        """Says so."""
        return "No language model is used: the replies come from a script."

    @property
    def prompts(self) -> list[str]:
        """The text of every prompt so far, its messages joined by blank lines."""
        return ["\n\n".join(m.content for m in request.messages) for request in self.requests]

    def complete(self, request: Request) -> Completion:
        """The next reply.

        Raises:
            BackendError: The script has run out.
        """
        self.requests.append(request)
        if self._function is not None:
            reply = self._function(request)
        else:
            try:
                reply = next(self._replies)
            except StopIteration:
                count = len(self.requests) - 1
                replies = "1 reply" if count == 1 else f"{count} replies"
                raise BackendError(f"the script has run out after {replies}.") from None
        if isinstance(reply, BaseException):
            raise reply
        return reply if isinstance(reply, Completion) else Completion(reply)


def stand_in_script(stand_in: StandIn) -> Callable[[Request], str]:
    """The script in which a domain's rule-based stand-in answers, as `Domain.stand_in` gives it."""
    return lambda request: stand_in(request.context, np.random.default_rng(request.seed))
