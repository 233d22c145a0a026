"""Registers the backend ``http`` and what it can reach."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from llm3.hookspecs import hookimpl
from llm3.interfaces import BackendSettings, LLMBackend, ModelSource


@hookimpl
def llm3_backends() -> Mapping[str, Callable[[BackendSettings], LLMBackend]]:
    """The backend of this package."""
    return {"http": _http}


@hookimpl
def llm3_model_sources() -> Mapping[str, Callable[[Mapping[str, str]], tuple[ModelSource, ...]]]:
    """The presets."""
    return {"http": _sources}


def _sources(environment: Mapping[str, str]) -> tuple[ModelSource, ...]:
    """The presets of the backend http; llm3 models shows them."""
    from llm3_http.sources import model_sources

    return model_sources(environment)


def _http(settings: BackendSettings) -> LLMBackend:
    """A model over HTTP: --model, LLM3_API_KEY, LLM3_BASE_URL; llm3 models shows where."""
    import os

    import numpy as np

    from llm3_http.backend import HttpBackend
    from llm3_http.settings import settings_from

    # Jitter keeps clients from coming back in step, so it must differ from run to run; no result depends on it.
    return HttpBackend(settings_from(settings, os.environ), rng=np.random.default_rng())
