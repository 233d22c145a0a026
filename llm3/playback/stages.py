"""Opens the stage of a domain."""

from __future__ import annotations

from typing import Any

from llm3.errors import MissingCapability
from llm3.guarded import guarded
from llm3.interfaces import Domain, Options, Scenery, Stage
from llm3.playback.from_above import FromAbove, seen_from_above
from llm3.playback.projected import open_view, projection
from llm3.types import State


def open_window(domain: Domain, instance: Any, options: Options) -> Stage:
    """A window on the screen.

    Raises:
        MissingCapability: The domain has none.
        LLM3Error: It cannot be opened, as there is no screen.
    """
    stage = guarded(domain.stage, (Stage, type(None)), instance, options, True)
    if stage is None:
        raise MissingCapability(domain.name, "window", "--gui")
    return stage


def open_scenery(domain: Domain, instance: Any, options: Options, needed_for: str) -> Scenery:
    """What the domain looks like in three dimensions.

    Raises:
        MissingCapability: The domain does not tell.
    """
    scenery = guarded(domain.scenery, (Scenery, type(None)), instance, options)
    if scenery is None:
        raise MissingCapability(domain.name, "scenery", needed_for)
    return scenery


def open_stage(domain: Domain, instance: Any, options: Options, start: State, needed_for: str) -> Stage:
    """Where pictures are made: the domain's own stage, or a drawing of what is seen from above.

    Args:
        domain: What the instance is of.
        instance: The problem.
        options: A value for every one of the domain's `options`.
        start: A state of the instance.
        needed_for: Who needs it, for the error.

    Raises:
        MissingCapability: Nothing of the domain can be seen.
    """
    stage = guarded(domain.stage, (Stage, type(None)), instance, options, False)
    if stage is not None:
        return stage
    if seen_from_above(domain, instance, options, start) is not None:
        return FromAbove(open_view(domain, instance, options, start, None))
    scenery = guarded(domain.scenery, (Scenery, type(None)), instance, options)
    if scenery is None:
        raise MissingCapability(domain.name, "stage, no top view and no scenery", needed_for)
    return FromAbove(projection(scenery))
