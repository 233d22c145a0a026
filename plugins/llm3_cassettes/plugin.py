"""Registers the backend ``replay``."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from llm3 import BackendSettings, LLMBackend, hookimpl


def _replay(settings: BackendSettings) -> LLMBackend:
    """No model is asked: replies from a recording, --llm replay:FILE or replay:FOLDER."""
    from llm3_cassettes.recordings import open_recording

    return open_recording(settings)


@hookimpl
def llm3_backends() -> Mapping[str, Callable[[BackendSettings], LLMBackend]]:
    """The backend of this package."""
    return {"replay": _replay}
