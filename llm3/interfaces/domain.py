"""What a domain plugin registers."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from llm3.interfaces.backend import Regions, StandIn
from llm3.interfaces.env import Env
from llm3.interfaces.executor import Executor
from llm3.interfaces.scenery import Scenery
from llm3.interfaces.stage import Stage
from llm3.interfaces.verifier import PlanVerifier
from llm3.types import Action, Noise, Shape, Sketch, State

Options = Mapping[str, str]
"""Domain options as the user wrote them (``-D key=value``)."""


@dataclass(frozen=True)
class Option:
    """An option that a domain takes from ``-D name=value``."""

    name: str
    default: str
    help: str
    choices: tuple[str, ...] = ()
    """The valid values; empty where any text is taken."""


class Domain(ABC):
    """A family of planning problems.

    A domain is cheap to make: simulators are imported and started in `make`. The methods below the line are
    capabilities: a domain that lacks one leaves it alone, and a command that needs it says so.
    """

    name: str
    description: str
    """One line for ``llm3 list``."""
    settings: tuple[str, ...]
    """Names of the problem families, at least one."""
    default_setting: str
    options: tuple[Option, ...] = ()
    instance_type: type[Any]
    """A frozen dataclass of JSON-safe fields; instance files hold one. Its `__post_init__` raises ValueError."""

    @abstractmethod
    def instance(self, setting: str, seed: int) -> Any:
        """The problem of this setting and seed, an `instance_type`; the same call gives the same problem."""

    @abstractmethod
    def make(self, instance: Any, options: Options) -> Env:
        """A world for the instance.

        Args:
            instance: An `instance_type`.
            options: A value for every one of the domain's `options`, checked against its choices.

        Raises:
            InstanceError: No world can be made of the instance, such as where things start in one another.
        """

    def self_contained(self, options: Options) -> Options:
        """The options as a record keeps them: in place of a file's name, what is in the file.

        `make` gets what this answers, now and when the record is read again, so this must take its own answer as well.

        Args:
            options: A value for every one of the domain's `options`.
        """
        return options

    # ---- capabilities: None means that the domain has none --------------------------------------------

    def skeleton(self, instance: Any) -> tuple[Sketch, ...] | None:  # noqa: ARG002  # part of the interface
        """The action sequence that `sample-params` and the random sampler fill in."""
        return None

    def pieces(self, instance: Any) -> tuple[tuple[Sketch, ...], ...] | None:  # noqa: ARG002  # part of the interface
        """Short action sequences that solve the problem one after another, in an order that has to be found.

        Where no strategy fixes the sequence, the random sampler draws the order of the pieces as well, and without
        pieces keeps to the `skeleton`.
        """
        return None

    def regions(self, instance: Any) -> Regions | None:  # noqa: ARG002  # part of the interface
        """Tighter ranges for random sampling than the schemas', such as the inside of a basket."""
        return None

    def witness(self, setting: str, seed: int) -> tuple[Action, ...] | None:  # noqa: ARG002  # part of the interface
        """Actions that solve the problem of a setting and a seed, so that whoever fails has only the method to blame.

        What makes the instance may know them; the instance, and whatever is told of it, must not. None where no
        solution is known. Options may make them useless, such as a robot with a shorter arm.
        """
        return None

    def stand_in(self) -> StandIn | None:
        """A rule-based stand-in for a model, which knows no more than the prompt tells."""
        return None

    def stage(self, instance: Any, options: Options, window: bool = False) -> Stage | None:  # noqa: ARG002  # as above
        """Where problems of this instance are shown: for ``--gui``, and for pictures and films.

        Without one, pictures are drawn from `top_view`, and there is no window.

        Args:
            instance: As for `make`.
            options: As for `make`.
            window: Whether it is to be a window on a screen; None if there is no such window.
        """
        return None

    def scenery(self, instance: Any, options: Options) -> Scenery | None:  # noqa: ARG002  # as above
        """What problems of this instance look like in three dimensions: for replays, and for the drawings of reports.

        Args:
            instance: As for `make`.
            options: As for `make`.
        """
        return None

    def remake(self, env: Env, instance: Any, options: Options) -> Env | None:  # noqa: ARG002  # part of the interface
        """A world for another instance out of one that is no longer needed, where that is cheaper than a new one.

        Nothing but the time that it takes may tell it from one of `make`.

        Args:
            env: A world that `make` or `remake` of such a domain made. It is used up: if the answer is a world, nobody
                uses or closes the old one any more; if it is None, or an error is raised, the caller closes it.
            instance: As for `make`.
            options: As for `make`.
        """
        return None

    def verifier(self, instance: Any, options: Options) -> PlanVerifier | None:  # noqa: ARG002  # part of the interface
        """A second look at plans of this instance, for ``llm3 verify``; it shares no code with `make`."""
        return None

    def executor(self, instance: Any, options: Options, noise: Noise) -> Executor | None:  # noqa: ARG002  # as above
        """Something that carries out plans of this instance, for ``llm3 execute``.

        Args:
            instance: As for `make`.
            options: As for `make`.
            noise: By how much its world differs from plans, if it is a simulated one.

        Raises:
            UsageError: It drives a robot, whose world has a noise of its own, and `noise` is not empty.
        """
        return None

    def top_view(self, instance: Any, options: Options, state: State) -> tuple[Shape, ...] | None:  # noqa: ARG002  # as above
        """The outlines of what matters in a state, seen from above, what lies on top last.

        Figures of the layouts that were tried are drawn with it, and pictures of a run where there is no `stage`.

        Args:
            instance: As for `make`.
            options: As for `make`.
            state: One of the instance's states. The robot, and what it holds, need not be shown.
        """
        return None
