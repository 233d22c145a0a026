"""Replies from a file: ``--llm scripted:replies.json``."""

from __future__ import annotations

from pathlib import Path

from llm3 import BackendSettings, LLMBackend
from llm3.errors import UsageError
from llm3.jsonio import read_file
from llm3.testing import ScriptedLLM


def scripted_from_file(settings: BackendSettings) -> LLMBackend:
    """A scripted backend whose replies are a JSON list of strings.

    Raises:
        UsageError: No file is named.
        InputError: The file holds something else.
    """
    if not settings.argument:
        raise UsageError(
            "the backend 'scripted' needs a JSON file with a list of replies: --llm scripted:replies.json."
        )
    return ScriptedLLM(read_file(Path(settings.argument), list[str]))
