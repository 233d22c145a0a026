"""From the events of a run to its exchanges with the model."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from llm3.assembly import RunConfig
from llm3.records.event_reader import read_events
from llm3.records.exchange import Exchange, exchange_of, request_of
from llm3.records.run_file import read_run
from llm3.types import CallFailed, Message, PromptSent, ReplyReceived, RunEvent


class Pairing:
    """Puts each prompt together with what came of it."""

    def __init__(self, config: RunConfig, language_model: bool) -> None:
        """Take what all exchanges of the run share."""
        self._config, self._language_model = config, language_model
        self._messages: tuple[Message, ...] = ()
        self._asked = 0.0

    def after(self, event: RunEvent, time: float) -> Exchange | None:
        """The exchange that ends with this event, if one does.

        Args:
            event: The next event of the run.
            time: When it happened, in seconds from any moment on.
        """
        if isinstance(event, PromptSent):
            self._messages, self._asked = event.messages, time
        if not isinstance(event, ReplyReceived | CallFailed):
            return None
        request = request_of(self._config, self._messages)
        return exchange_of(self._config.run_name, self._language_model, request, event, time - self._asked)


def read_exchanges(folder: Path) -> Iterator[Exchange]:
    """The exchanges of a recorded run with its model, in order; of a run that was cut off, all up to there.

    Args:
        folder: The run's folder.

    Raises:
        InputError: The record is not as documented; the error names the line.
    """
    run = read_run(folder)
    pairing = Pairing(run.config, run.language_model)
    for recorded in read_events(folder):
        if exchange := pairing.after(recorded.event, recorded.time):
            yield exchange
