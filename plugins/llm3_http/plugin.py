"""Registers the backend ``http``."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from llm3.hookspecs import hookimpl
from llm3.interfaces import BackendSettings, LLMBackend


@hookimpl
def llm3_backends() -> Mapping[str, Callable[[BackendSettings], LLMBackend]]:
    """The backend of this package."""
    return {"http": _http}


def _http(settings: BackendSettings) -> LLMBackend:
    """A model behind OpenAI's chat completions: LLM3_BASE_URL, LLM3_API_KEY, --model."""
    import os

    import numpy as np

    from llm3_http.backend import HttpBackend
    from llm3_http.settings import settings_from

    # Jitter keeps clients from coming back in step, so it must differ from run to run; no result depends on it.
    return HttpBackend(settings_from(settings, os.environ), rng=np.random.default_rng())
