"""The backend ``litellm``."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any
from urllib.parse import quote

import numpy as np
from tenacity import RetryCallState, Retrying, retry_if_exception

from llm3.errors import BackendError
from llm3.interfaces import BackendSettings, LLMBackend
from llm3.types import Completion, Request, Stats

ATTEMPTS = 5
"""Requests for one completion, the first one included."""
LONGEST_WAIT = 30.0
"""Seconds at which the doubling of the waits between them ends."""
SECONDS = 900.0
"""What one completion may take, all requests and waits together."""
_MAY_PASS = frozenset({408, 409, 425, 429})
_SECRET_NAMES = ("KEY", "TOKEN", "SECRET", "PASSWORD")
"""How names of environment variables end that hold secrets."""
_PLACEHOLDER = 8  # shorter values are no secrets
_SHOWN = 200
_SHORTEST = 0.001  # seconds: a timeout of zero would mean none
_MOST = 10**12  # tokens; a larger number is none

Complete = Callable[..., Any]
"""``litellm.completion``."""


class LiteLLMBackend(LLMBackend):
    """A model that LiteLLM reaches. Keys come from the environment, by the names that LiteLLM documents."""

    def __init__(
        self,
        settings: BackendSettings,
        complete: Complete,
        environment: Mapping[str, str],
        *,
        rng: np.random.Generator,
        sleep: Callable[[float], None] = time.sleep,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Make a backend; nothing is sent yet.

        Args:
            settings: What the user asked.
            complete: ``litellm.completion``.
            environment: The environment variables: values of keys in it are kept out of all texts.
            rng: For the jitter of the waits between retries.
            sleep: Waits for a number of seconds.
            clock: Monotonic seconds.
        """
        self._model, self._complete = settings.model or "", complete
        asked = {"temperature": settings.temperature, "max_tokens": settings.max_reply_tokens}
        self._asked = {name: value for name, value in asked.items() if value is not None}
        secrets = {
            value
            for name, value in environment.items()
            if name.upper().endswith(_SECRET_NAMES) and len(value) >= _PLACEHOLDER
        }
        self._secrets = sorted(secrets, key=len, reverse=True)  # one may be the beginning of another
        self._rng, self._sleep, self._clock = rng, sleep, clock

    def complete(self, request: Request) -> Completion:
        """Send the messages and read the answer, again where the failure may pass."""
        messages = [{"role": message.role, "content": message.content} for message in request.messages]
        until = self._clock() + min(SECONDS, request.seconds)
        notes: list[str] = []
        draws = self._rng.random(ATTEMPTS)

        def wait(state: RetryCallState) -> float:
            before = state.attempt_number - 1
            return float(min(LONGEST_WAIT, 2.0**before) * (0.5 + draws[before] / 2))

        def give_up(state: RetryCallState) -> bool:
            return state.attempt_number >= ATTEMPTS or self._clock() + wait(state) >= until

        def note(state: RetryCallState) -> None:
            error = state.outcome.exception() if state.outcome else None
            notes.append(f"{self._told(error)}; asked again after {wait(state):.1f} s")

        attempts = Retrying(
            retry=retry_if_exception(_may_pass),
            wait=wait,
            stop=give_up,
            sleep=self._sleep,
            before_sleep=note,
            reraise=True,
        )
        try:
            # One retry layer: neither LiteLLM nor the client below it is to have its own.
            response = attempts(
                lambda: self._complete(
                    model=self._model,
                    messages=messages,
                    timeout=max(_SHORTEST, until - self._clock()),
                    num_retries=0,
                    max_retries=0,
                    **self._asked,
                )
            )
        except Exception as error:
            sentence = f"LiteLLM gets no answer from {self._model!r}: {self._told(error)}"
            early = _may_pass(error) and len(notes) + 1 < ATTEMPTS and request.seconds < SECONDS
            raise BackendError(sentence, retries=len(notes) + 1, out_of_time=early) from None
        answer = _completion(response)
        if answer is None:
            sentence = f"LiteLLM's answer from {self._model!r} has no message in it: give another --model"
            raise BackendError(sentence, retries=len(notes) + 1)
        texts = ("text", "reasoning", "model", "finish_reason")
        return replace(
            answer,
            **{name: self._clean(getattr(answer, name)) for name in texts},
            stats=replace(answer.stats, retries=len(notes)),
            notes=tuple(notes),
        )

    def _told(self, error: BaseException | None) -> str:
        text = " ".join(self._clean(f"{type(error).__name__}: {error}").split())
        return text if len(text) <= _SHOWN else f"{text[: _SHOWN - 1]}…"

    def _clean(self, text: str) -> str:
        for secret in self._secrets:
            for spelling in (secret, json.dumps(secret)[1:-1], quote(secret, safe="")):
                text = text.replace(spelling, "***")
        return text.encode(errors="replace").decode()


def _may_pass(error: BaseException) -> bool:
    status = getattr(error, "status_code", None)
    return isinstance(status, int) and (status in _MAY_PASS or status >= 500)


def _completion(response: Any) -> Completion | None:
    """The answer in LiteLLM's response, which has the form of OpenAI's; None where there is none."""
    choices = getattr(response, "choices", None)
    choice, usage = (choices[0] if isinstance(choices, list) and choices else None), getattr(response, "usage", None)
    message = getattr(choice, "message", None)
    if message is None:
        return None
    return Completion(
        text=_text(message, "content"),
        stats=Stats(
            prompt_tokens=_count(usage, "prompt_tokens"),
            cached_tokens=_count(getattr(usage, "prompt_tokens_details", None), "cached_tokens"),
            completion_tokens=_count(usage, "completion_tokens"),
            reasoning_tokens=_count(getattr(usage, "completion_tokens_details", None), "reasoning_tokens"),
        ),
        model=_text(response, "model"),
        finish_reason=_text(choice, "finish_reason"),
        reasoning=_text(message, "reasoning_content"),
    )


def _text(holder: object, name: str) -> str:
    value = getattr(holder, name, None)
    if isinstance(value, list):  # of parts, as some providers have it
        value = "".join(part.get("text") or "" for part in value if isinstance(part, dict))
    return value if isinstance(value, str) else ""


def _count(holder: object, name: str) -> int:
    value = getattr(holder, name, None)
    return value if isinstance(value, int) and 0 <= value <= _MOST else 0
