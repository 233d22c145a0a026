"""Registers the backend ``litellm``."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from llm3.errors import MissingDependency, UsageError
from llm3.hookspecs import hookimpl
from llm3.interfaces import BackendSettings, LLMBackend


@hookimpl
def llm3_backends() -> Mapping[str, Callable[[BackendSettings], LLMBackend]]:
    """The backend of this package."""
    return {"litellm": _litellm}


def _litellm(settings: BackendSettings) -> LLMBackend:
    """A model of any provider that LiteLLM knows: --llm litellm --model bedrock/NAME."""
    import os

    import numpy as np

    from llm3_litellm.backend import LiteLLMBackend

    if settings.argument is not None:
        raise UsageError(f"the backend 'litellm' takes no argument, so leave out ':{settings.argument}'.")
    if settings.model is None:
        raise UsageError("the backend 'litellm' needs the name of a model: give --model PROVIDER/NAME.")
    # It would ask the network for a table of prices while it is imported.
    os.environ.setdefault("LITELLM_LOCAL_MODEL_COST_MAP", "True")
    try:
        import litellm
    except ImportError as error:
        raise MissingDependency("the backend 'litellm' needs LiteLLM: pip install 'llm3[litellm]'.") from error
    return LiteLLMBackend(settings, litellm.completion, os.environ, rng=np.random.default_rng())
