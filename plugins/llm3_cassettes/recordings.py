"""From what the user names to a backend that answers from it."""

from __future__ import annotations

from pathlib import Path

from llm3 import BackendSettings
from llm3.errors import UsageError
from llm3.records import read_cassette, read_exchanges, read_run
from llm3_cassettes.backends import CassetteReplay, FolderReplay, Replay
from llm3_cassettes.model_settings import ModelSettings, chosen, settings_of


def open_recording(settings: BackendSettings) -> Replay:
    """A backend that answers from a cassette or, given a run's folder, from its record.

    All of it is read now, so that damage is told before anything is overwritten.

    Raises:
        UsageError: Nothing is named, or another model than the recorded one is asked for.
        InputError: It cannot be read, or does not have the documented form.
    """
    if not settings.argument:
        raise UsageError("the backend 'replay' needs a cassette, or the folder of a run: --llm replay:cassette.jsonl.")
    path = Path(settings.argument)
    wanted = ModelSettings(settings.model, settings.temperature, settings.max_reply_tokens)
    if path.is_dir():
        run = read_run(path)
        asked = ModelSettings(run.config.model, run.config.temperature, run.config.max_reply_tokens)
        chosen(path, wanted, (asked,))
        return FolderReplay(path, tuple(read_exchanges(path)), run)
    exchanges = tuple(read_cassette(path))
    of_run = tuple(exchange for exchange in exchanges if settings.run in ("", exchange.run))
    recorded = tuple(dict.fromkeys(map(settings_of, of_run)))
    return CassetteReplay(path, exchanges, of_run, settings.run, chosen(path, wanted, recorded))
