"""A problem and the world that was made for it."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from types import TracebackType
from typing import Any

from llm3.assembly.choices import settle_options
from llm3.errors import InstanceError
from llm3.guarded import guarded
from llm3.interfaces import Domain, Env, Options


@dataclass
class Problem:
    """A domain's instance, its options, and the world made from them. Close it, or use it in a ``with``."""

    domain: Domain
    instance: Any
    options: Options
    env: Env
    _released: bool = field(default=False, init=False, repr=False, compare=False)

    def release(self) -> Env:
        """Give the world away: whoever takes it closes it, and closing the problem leaves it open."""
        self._released = True
        return self.env

    def close(self) -> None:
        """Let go of the world, unless it was given away. Calling it twice does no harm."""
        if not self._released:
            self.env.close()

    def __enter__(self) -> Problem:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()


def open_problem(domain: Domain, instance: Any, options: Mapping[str, str], source: str = "") -> Problem:
    """Make the world of an instance.

    Its options are those that a record keeps: `Domain.self_contained`.

    Args:
        domain: What it is a problem of.
        instance: The problem.
        options: Those that differ from their defaults.
        source: Where the instance comes from, such as its file, for messages about it.

    Raises:
        UnknownName: The domain has no such option.
        InstanceError: No world can be made of the instance.
    """
    chosen = settle_options(domain, options)
    return Problem(domain, instance, chosen, open_world(domain, instance, chosen, source=source))


def open_world(domain: Domain, instance: Any, options: Options, spare: Env | None = None, source: str = "") -> Env:
    """A world for an instance, out of a spare one where the domain can do that.

    The spare world is used up in any case.

    Raises:
        InstanceError: No world can be made of the instance; the source, if there is one, comes first.
    """
    try:
        return _world(domain, instance, options, spare)
    except InstanceError as error:
        if not source:
            raise
        raise InstanceError(f"{source}: {error}") from error


def _world(domain: Domain, instance: Any, options: Options, spare: Env | None) -> Env:
    remade = None if spare is None else _remade(domain, instance, options, spare)
    return guarded(domain.make, (Env,), instance, options) if remade is None else remade


def _remade(domain: Domain, instance: Any, options: Options, spare: Env) -> Env | None:
    env = None
    try:
        env = guarded(domain.remake, (Env, type(None)), spare, instance, options)
    finally:
        if env is None:
            with suppress(Exception):  # it has done its work, and the new world must not answer for it
                spare.close()
    return env
