"""Makes the worlds of a domain, looks at each, and closes them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from llm3.errors import PluginError
from llm3.interfaces import Domain, Env
from llm3.testing.conformance import domain_rules as rules
from llm3.testing.conformance.catalogue_rules import default_options
from llm3.testing.conformance.exploring import explore
from llm3.testing.conformance.helpers import Helpers
from llm3.testing.conformance.inspection import Inspection
from llm3.testing.conformance.look import Look
from llm3.testing.conformance.purity_rules import draws
from llm3.testing.conformance.remarks import idle_parameters
from llm3.testing.conformance.schema_rules import usable
from llm3.testing.conformance.twin_rules import Neighbour
from llm3.testing.conformance.world import World


@dataclass(frozen=True)
class Problem:
    """One problem to look at."""

    where: str
    """What sentences about it begin with."""
    setting: str
    seed: int
    instance: Callable[[], Any]
    dear: bool
    """Whether rules are looked at, too, that take long."""


@dataclass
class Looker:
    """Looks at one problem after the other.

    The first one has a twin, which `Domain.remake` then turns into the problem of each other world, as a series of runs
    does: so a domain is asked for few new worlds, which may be dear.
    """

    domain: Domain
    helpers: Helpers
    inspection: Inspection
    clock: Callable[[], float]

    def worlds(self, problems: Sequence[Problem]) -> Iterator[World]:
        """The worlds of these problems, each once all was looked at and it was closed."""
        self._open: list[Env] = []
        spare: Env | None = None
        earlier: World | None = None  # of which the spare one is
        try:
            for number, problem in enumerate(problems):
                try:
                    beside = Neighbour.of(earlier, spare) if earlier and earlier.pure and spare else None
                    world = self._world(problem, spare, twin=not number)
                except (Exception, SystemExit) as error:
                    self.inspection.raised(error, problem.where)
                    continue
                self.inspection.worlds += 1
                if beside is not None:
                    self.inspection.apply(rules.FOREIGN_RULES, beside, problem.where)
                self._look_at(world, problem.dear)
                if world.remade is not None:
                    self._open = [other for other in self._open if other is not spare] + [world.remade]
                if world.remade or spare is None:
                    spare, earlier = world.remade or world.twin, world
                self._open.remove(world.env)  # it was closed at last
                yield world
        finally:
            for env in self._open:
                try:
                    env.close()
                except (Exception, SystemExit) as error:
                    self.inspection.raised(error)

    def _world(self, problem: Problem, spare: Env | None, twin: bool) -> World:
        instance, options = problem.instance(), default_options(self.domain)

        def made() -> Env:
            with draws("make", problem.where, self.inspection):
                env = self.domain.make(instance, options)
            if not isinstance(env, Env):
                raise PluginError(f"{type(self.domain).__name__}.make must answer Env, not {type(env).__name__}.")
            self._open.append(env)
            return env

        return World(
            self.domain,
            problem.setting,
            problem.seed,
            instance,
            options,
            made(),
            made() if twin else None,
            spare,
            made,
            self.helpers,
            self.clock,
            problem.where,
        )

    def _look_at(self, world: World, dear: bool) -> None:
        inspection, where = self.inspection, world.where
        inspection.apply(rules.FORM_RULES, world, where)
        if not usable(world):  # what follows goes by the actions and the objects
            inspection.apply(rules.LAST_RULES, world, where)
            return
        try:
            world.look = Look.at(world.env)
        except (Exception, SystemExit) as error:
            inspection.raised(error, where)
        explore(world, inspection)
        inspection.apply(rules.LOSSES, world, where)
        for raised in world.raised:
            inspection.raised(raised, where)
        inspection.apply(rules.FIRST_RULES, world, where)
        world.pure = inspection.apply(rules.MEMORY_RULES, world, where)
        inspection.apply((*rules.WORLD_RULES, *(rules.DEAR_RULES if dear else ())), world, where)
        world.pure &= inspection.apply(rules.PURITY_RULES, world, where)
        if world.pure:
            inspection.apply(rules.TWIN_RULES, world, where)
            try:
                world.idle = idle_parameters(world)
            except (Exception, SystemExit) as error:
                inspection.raised(error, where)
        inspection.apply(rules.LAST_RULES, world, where)
        for stumble in world.errors:
            by_the_world = str(stumble).startswith(f"{type(world.env).__name__}.")
            (inspection.raised if by_the_world else inspection.stumbled)(stumble, where)
