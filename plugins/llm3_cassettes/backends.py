"""Backends that answer from a recording."""

from __future__ import annotations

from abc import abstractmethod
from collections import Counter
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

from llm3 import LLMBackend
from llm3.errors import BackendError
from llm3.records import Exchange, RecordedRequest, RunFile
from llm3.types import Completion, Message, Request
from llm3_cassettes.difference import first_difference, nearest
from llm3_cassettes.model_settings import ModelSettings, settings_of

ENDINGS = {
    "running": "was cut off",
    "interrupted": "was interrupted",
    "error": "ended with an error",
    "solved": "was solved",
    "not solved": "was not solved",
}
"""How a run ended, by its status."""


class Replay(LLMBackend):
    """What both kinds of recordings have in common."""

    def __init__(self, path: Path, exchanges: tuple[Exchange, ...], language_model: bool) -> None:
        """Take the exchanges of the run that is to be replayed."""
        self._path, self._exchanges, self._language_model = path, exchanges, language_model
        self._answered = 0

    @property
    def is_language_model(self) -> bool:
        """What the recording says."""
        return self._language_model

    @property
    def notice(self) -> str:
        """Says that nobody is asked."""
        if not self._language_model:
            return f"No language model is used: the replies are replayed from '{self._path}', recorded without one."
        models = sorted({e.request.model or (e.reply.model if e.reply else "") for e in self._exchanges} - {""})
        return (
            f"No model is asked: the replies of {' and '.join(models) or 'a model'} are replayed from '{self._path}'."
        )

    def complete(self, request: Request) -> Completion:
        """The recorded reply.

        Raises:
            BackendError: The recording has none, or an error in its place.
        """
        exchange = self._find(request.messages)
        self._answered += 1
        completion = exchange.completion
        if completion is None:
            usage = exchange.usage
            raise BackendError(
                f"the call failed in the recording '{self._path}', too: {exchange.error}",
                retries=usage.retries,
                step_downs=usage.step_downs,
            )
        return completion

    @property
    def last_words(self) -> str:
        """Whether the run repeated the recording."""
        asked, there = _prompts(self._answered), len(self._exchanges)
        if self._answered < there:
            return f"the run parted from its recording: it ended after {asked}, and '{self._path}' has {there}."
        return f"the run repeated its recording: {asked}."

    @abstractmethod
    def _find(self, messages: tuple[Message, ...]) -> Exchange:
        """The exchange that a prompt is answered from."""


class FolderReplay(Replay):
    """Repeats a run from its own record: prompt by prompt, in order."""

    def __init__(self, path: Path, exchanges: tuple[Exchange, ...], run: RunFile) -> None:
        """Take the record."""
        # A last call that the run's time cut short is no part of what can be repeated.
        repeatable = tuple(exchange for exchange in exchanges if exchange.reply) if run.stop else exchanges
        super().__init__(path, repeatable, run.language_model)
        self._ending, self._out_of_time = ENDINGS[run.status], run.stop == "seconds"
        self._lost = run.stats.llm_calls - sum(exchange.reply is not None for exchange in exchanges)

    def _find(self, messages: tuple[Message, ...]) -> Exchange:
        if self._answered == len(self._exchanges):
            asked = _prompts(self._answered)
            reason = "events.jsonl has lost the rest" if self._lost > 0 else f"its run {self._ending}"
            sentence = f"the recording '{self._path}' ends after {asked}: {reason}."
            raise BackendError(sentence, out_of_time=self._out_of_time and self._lost <= 0)
        exchange = self._exchanges[self._answered]
        difference = first_difference(exchange.request.messages, messages)
        if difference:
            number = self._answered + 1
            raise BackendError(f"the run parted from its recording '{self._path}' at prompt {number}: {difference}.")
        return exchange


class CassetteReplay(Replay):
    """Answers a prompt that the same run was sent, for each time that it was sent."""

    def __init__(
        self,
        path: Path,
        everything: tuple[Exchange, ...],
        of_run: tuple[Exchange, ...],
        run: str,
        settings: ModelSettings,
    ) -> None:
        """Take the cassette.

        Args:
            path: Where it is.
            everything: All of its exchanges.
            of_run: Those of the run.
            run: The run's name, for messages.
            settings: What the run's model was asked with; exchanges with others are no part of this run.
        """
        mine = tuple(exchange for exchange in of_run if settings_of(exchange) == settings)
        super().__init__(path, mine, any(exchange.language_model for exchange in mine or everything))
        self._everything, self._run, self._settings = everything, run, settings
        self._asked: Counter[str] = Counter()

    @property
    def recorded(self) -> Mapping[str, Any]:
        """The settings of the model, which a new recording keeps."""
        return asdict(self._settings)

    def _find(self, messages: tuple[Message, ...]) -> Exchange:
        settings = self._settings
        request = RecordedRequest(messages, settings.model, settings.temperature, settings.max_reply_tokens)
        digest = request.digest
        answers = [exchange for exchange in self._exchanges if exchange.digest == digest]
        if self._asked[digest] == len(answers):
            raise BackendError(self._missing(messages, len(answers)))
        self._asked[digest] += 1
        return answers[self._asked[digest] - 1]

    def _missing(self, messages: tuple[Message, ...], answers: int) -> str:
        """The sentence for a prompt that is not there."""
        number = self._answered + 1
        if answers:
            times = "once" if answers == 1 else f"{answers} times"
            return f"prompt {number} is in the recording '{self._path}' {times} only, and asked once more."
        like = nearest(messages, self._exchanges or self._everything)
        if like is None:
            return f"the recording '{self._path}' holds no prompt at all."
        difference = first_difference(like.request.messages, messages) or "the prompts are the same, the runs are not"
        where = f"the nearest is prompt {like.number} of run '{like.run}'"
        return f"prompt {number} of run '{self._run}' is not in the recording '{self._path}'; {where}: {difference}."


def _prompts(number: int) -> str:
    return f"{number} prompt{'s' * (number != 1)}"
