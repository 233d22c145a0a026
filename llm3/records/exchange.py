"""A question to a model and what came of it, as it goes to disk."""

from __future__ import annotations

from dataclasses import dataclass, fields
from hashlib import sha256

from llm3.assembly import RunConfig
from llm3.jsonio import dumps
from llm3.types import CallFailed, Completion, Message, ReplyReceived, Stats
from llm3.types.checks import texts


@dataclass(frozen=True)
class RecordedRequest:
    """All that decides what a model answers: what it is asked, and how it is set."""

    messages: tuple[Message, ...]
    model: str | None
    temperature: float | None
    max_reply_tokens: int | None

    def __post_init__(self) -> None:
        if self.temperature is not None:  # 0 and 0.0 are written differently
            object.__setattr__(self, "temperature", float(self.temperature))

    @property
    def digest(self) -> str:
        """The SHA-256 of its canonical text, in hexadecimal digits."""
        return sha256(dumps(self).encode()).hexdigest()


def request_of(config: RunConfig, messages: tuple[Message, ...]) -> RecordedRequest:
    """The request that a run makes with these messages."""
    return RecordedRequest(messages, config.model, config.temperature, config.max_reply_tokens)


@dataclass(frozen=True)
class RecordedReply:
    """What the model answered."""

    text: str
    reasoning: str
    finish_reason: str
    model: str
    """As the server names it."""


@dataclass(frozen=True)
class Usage:
    """What the answer cost; see `Stats`."""

    prompt_tokens: int = 0
    cached_tokens: int = 0
    completion_tokens: int = 0
    reasoning_tokens: int = 0
    retries: int = 0
    step_downs: int = 0


@dataclass(frozen=True)
class Exchange:
    """A request of a run, and the reply to it or the error in its place."""

    run: str
    """The problem and the method: `RunConfig.run_name`."""
    number: int
    """Its place in the run, counted from 1."""
    language_model: bool
    """False where no language model was asked."""
    request: RecordedRequest
    digest: str
    """The SHA-256 of the request."""
    reply: RecordedReply | None
    """None if there was none."""
    error: str
    """Why there was none."""
    usage: Usage
    seconds: float
    """How long it took."""
    notes: tuple[str, ...]
    """What it took to get the answer."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "notes", texts("the notes of an exchange", self.notes))
        if self.digest != self.request.digest:
            raise ValueError(f"the digest is not that of the request, {self.request.digest}")

    @property
    def completion(self) -> Completion | None:
        """The reply as it came; None if there was none."""
        if self.reply is None:
            return None
        stats = Stats(**{field.name: getattr(self.usage, field.name) for field in fields(Usage)})
        reply = self.reply
        return Completion(reply.text, stats, reply.model, reply.finish_reason, reply.reasoning, self.notes)


def exchange_of(
    run: str, language_model: bool, request: RecordedRequest, ending: ReplyReceived | CallFailed, seconds: float
) -> Exchange:
    """The exchange of a request that ended with this event."""
    reply, error = None, ""
    notes: tuple[str, ...] = ()
    if isinstance(ending, CallFailed):
        error, spent = ending.error, ending.stats
    else:
        answer, spent = ending.completion, ending.completion.stats
        reply = RecordedReply(answer.text, answer.reasoning, answer.finish_reason, answer.model)
        notes = answer.notes
    usage = Usage(**{field.name: getattr(spent, field.name) for field in fields(Usage)})
    return Exchange(
        run, ending.attempt, language_model, request, request.digest, reply, error, usage, round(seconds, 3), notes
    )
