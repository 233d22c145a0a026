"""The settings that belong to a model: a replay takes them from the recording."""

from __future__ import annotations

from dataclasses import dataclass, fields
from pathlib import Path

from llm3.errors import UsageError
from llm3.records import Exchange


@dataclass(frozen=True)
class ModelSettings:
    """What a model was asked with; None where nothing was said."""

    model: str | None
    temperature: float | None
    max_reply_tokens: int | None

    def fits(self, wanted: ModelSettings) -> bool:
        """Whether they are those that the user names, who need not name them all."""
        pairs = [(getattr(self, field.name), getattr(wanted, field.name)) for field in fields(self)]
        return all(asked is None or asked == recorded for recorded, asked in pairs)

    def __str__(self) -> str:
        """The flags that would ask for them."""
        given = [(field.name.replace("_", "-"), getattr(self, field.name)) for field in fields(self)]
        return " ".join(f"--{name} {value}" for name, value in given if value is not None) or "no model's flags"


def settings_of(exchange: Exchange) -> ModelSettings:
    """With what a model was asked."""
    request = exchange.request
    return ModelSettings(request.model, request.temperature, request.max_reply_tokens)


def chosen(path: Path, wanted: ModelSettings, recorded: tuple[ModelSettings, ...]) -> ModelSettings:
    """The recorded settings that the user means; what the user names if there are none.

    Raises:
        UsageError: The recording has others only, or several between which the user must choose.
    """
    if not recorded:
        return wanted
    fitting = [settings for settings in recorded if settings.fits(wanted)]
    there = "; ".join(map(str, recorded))
    if not fitting:
        raise UsageError(f"the recording '{path}' was made with {there}, not with {wanted}: leave the latter out.")
    if len(fitting) > 1:
        raise UsageError(f"the recording '{path}' holds several: {there}. Choose one of them.")
    return fitting[0]
