"""What can be seen of a run's problem, and what it would take to see more."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from types import TracebackType
from typing import Any, TypeVar

from llm3.errors import MissingCapability, MissingDependency
from llm3.guarded import guarded
from llm3.interfaces import Domain, Options, Scenery, Stage
from llm3.playback import View, open_scenery, open_view
from llm3.types import State

T = TypeVar("T")


@dataclass(frozen=True)
class Sights:
    """Each is None where the domain does not have it, or where something is not installed. Use it in a ``with``."""

    view: View | None
    """From above."""
    stage: Stage | None
    """Pictures."""
    scenery: Scenery | None
    """Three dimensions."""
    notes: tuple[str, ...]
    """What is not installed, and so not to be seen."""

    @property
    def robot(self) -> tuple[str, ...]:
        """The names of the robot's parts."""
        return tuple(body.name for body in self.scenery.bodies if body.kind == "robot") if self.scenery else ()

    def __enter__(self) -> Sights:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if self.stage:
            self.stage.close()


UNSEEN = Sights(None, None, None, ())
"""Of a run that was cut off before it began."""


def open_sights(domain: Domain, instance: Any, options: Options, start: State, pictures: bool) -> Sights:
    """Everything that can be seen of a problem.

    Args:
        domain: What the instance is of.
        instance: The problem.
        options: A value for every one of the domain's `options`.
        start: A state of the instance.
        pictures: Whether a stage is wanted, too.

    Raises:
        PluginError: The domain fails.
    """
    notes: dict[str, None] = {}  # each once, in order

    def opened(open_it: Callable[[], T]) -> T | None:
        try:
            return open_it()
        except MissingCapability:
            return None
        except MissingDependency as error:
            notes[str(error)] = None
            return None

    scenery = opened(lambda: open_scenery(domain, instance, options, "llm3 report"))
    view = opened(lambda: open_view(domain, instance, options, start, scenery))
    stage = opened(lambda: _own_stage(domain, instance, options)) if pictures else None
    return Sights(view, stage, scenery, tuple(notes))


def _own_stage(domain: Domain, instance: Any, options: Options) -> Stage | None:
    """The domain's own: without one, what is seen from above is drawn sharper than as a picture."""
    if find_spec("PIL") is None:
        raise MissingDependency("pictures need Pillow, which is not installed: pip install 'llm3[viz]'.")
    return guarded(domain.stage, (Stage, type(None)), instance, options, False)
