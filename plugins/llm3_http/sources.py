"""What ``llm3 models`` shows of the presets."""

from __future__ import annotations

from collections.abc import Mapping

from llm3.interfaces import ModelSource
from llm3_http.presets import known_presets
from llm3_http.settings import API_KEY, key_variable


def model_sources(environment: Mapping[str, str]) -> tuple[ModelSource, ...]:
    """The presets, in the order of their names.

    Args:
        environment: The environment variables.

    Raises:
        InputError: The user's file of presets cannot be used.
    """
    found = []
    for name, preset in sorted(known_presets(environment).items()):
        variable = key_variable(preset, environment)
        asked = (variable,) if variable else (API_KEY, *preset.key_variables)
        found.append(
            ModelSource(
                name,
                preset.base_url,
                "set" if variable else "not set" if preset.needs_key else "not needed",
                asked,
            )
        )
    return tuple(found)
