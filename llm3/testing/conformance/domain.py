"""The check of a domain: makes worlds itself, and closes them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from llm3.errors import PluginError, UnknownName
from llm3.interfaces import Domain, Env, Options
from llm3.registry import Registry
from llm3.testing.conformance import (
    capability_rules,
    catalogue_rules,
    description_rules,
    memory_rules,
    motion_rules,
    outcome_rules,
    purity_rules,
    schema_rules,
    state_rules,
    text_rules,
    twin_rules,
)
from llm3.testing.conformance.catalogue_rules import Catalogue, default_options
from llm3.testing.conformance.complaint import Complaint, Report
from llm3.testing.conformance.exploring import explore
from llm3.testing.conformance.helpers import PLANNER, Helpers
from llm3.testing.conformance.inspection import Inspection
from llm3.testing.conformance.motion_rules import NO_EXPLANATION
from llm3.testing.conformance.world import World
from llm3.types import ActionSchema

INSTEAD = "every state has an answer, and what the robot cannot do is a Failure, and not an exception"
FIRST_RULES = (*state_rules.RULES, *schema_rules.RULES, *outcome_rules.RULES)
MEMORY_RULES = memory_rules.RULES
"""Looked at before other rules are misled by what a world remembers."""
WORLD_RULES = (*motion_rules.RULES, *text_rules.RULES, *description_rules.RULES, *capability_rules.RULES)
PURITY_RULES = purity_rules.RULES
TWIN_RULES = (*twin_rules.RULES, capability_rules.a_remade_world_is_like_a_new_one)
"""Looked at where a world keeps nothing to itself; another could not be compared with it."""
DEAR_RULES = (capability_rules.the_verifier_tells_good_plans_from_bad,)
"""Looked at in the first problem of each setting only."""
LAST_RULES = (twin_rules.closing_twice_does_no_harm,)
"""The world is closed after them."""
RULES = (
    catalogue_rules.a_domain_says_what_it_is,
    *catalogue_rules.RULES,
    *FIRST_RULES,
    *MEMORY_RULES,
    *WORLD_RULES,
    *DEAR_RULES,
    *PURITY_RULES,
    *TWIN_RULES,
    *LAST_RULES,
    *catalogue_rules.LAST_RULES,
)
"""All of them, in the order in which they are looked at."""


def check_domain(
    domain: Domain, *, setting: str | None = None, seeds: Sequence[int] = (0, 1), registry: Registry | None = None
) -> tuple[Complaint, ...]:
    """Look for faults in a domain and in its worlds, which it makes and closes itself.

    The whole test of a domain is ``assert check_domain(Corridor()) == ()``.

    Args:
        domain: The domain; its options stay at their defaults.
        setting: Which setting to look at; None: all of them.
        seeds: Which problems of each setting.
        registry: Where the planner and the strategies come from that its worlds are tried with; None: all that is
            installed.

    Raises:
        UnknownName: The domain has no such setting.
    """
    found = Registry.discover() if registry is None else registry
    return examine_domain(domain, found, setting=setting, seeds=seeds).complaints


def examine_domain(
    domain: Domain, registry: Registry, *, setting: str | None = None, seeds: Sequence[int] = (0, 1)
) -> Report:
    """Like :func:`check_domain`, with the remarks and with what was looked at.

    Args:
        domain: The domain.
        registry: Where the planner and the strategies come from that its worlds are tried with.
        setting: Which setting to look at; None: all of them.
        seeds: Which problems of each setting.

    Raises:
        UnknownName: The domain has no such setting.
    """
    inspection = Inspection(INSTEAD)
    inspection.apply((catalogue_rules.a_domain_says_what_it_is,), Catalogue(domain, ()))
    if inspection.report.complaints:
        return inspection.report  # what follows goes by these names
    if setting is not None and setting not in domain.settings:
        raise UnknownName("setting", setting, domain.settings, owner=f"domain {domain.name!r}")
    settings = tuple(domain.settings) if setting is None else (setting,)
    inspection.apply(catalogue_rules.RULES, Catalogue(domain, settings))
    helpers = Helpers.of(registry)
    if helpers.planner is None:
        inspection.remark(f"No planner {PLANNER!r} is registered, so no motion was carried out.")
    problems = [(name, seed) for name in settings for seed in seeds]
    worlds = list(_looked_at(domain, problems, helpers, inspection))
    inspection.apply(catalogue_rules.LAST_RULES, Catalogue(domain, settings))
    _remark_on(worlds, inspection)
    return inspection.report


def _looked_at(
    domain: Domain, problems: Sequence[tuple[str, int]], helpers: Helpers, inspection: Inspection
) -> Iterator[World]:
    """The worlds of these settings and seeds, each once all was looked at.

    The first one has a twin, which `Domain.remake` then turns into the problem of each other world, as a series of runs
    does: so a domain is asked for few new worlds, which may be dear.
    """
    open_worlds: list[Env] = []

    def made(instance: Any, options: Options) -> Env:
        env = domain.make(instance, options)
        if not isinstance(env, Env):
            raise PluginError(f"{type(domain).__name__}.make must answer Env, not {type(env).__name__}.")
        open_worlds.append(env)
        return env

    spare: Env | None = None
    try:
        for number, (setting, seed) in enumerate(problems):
            where = f"{setting}, seed {seed}"
            try:
                instance, options = domain.instance(setting, seed), default_options(domain)
                env = made(instance, options)
                twin = None if number else made(instance, options)
                world = World(domain, setting, seed, instance, options, env, twin, spare, helpers)
            except (Exception, SystemExit) as error:
                inspection.raised(error, where)
                continue
            inspection.worlds += 1
            explore(world, inspection)
            dear = DEAR_RULES if seed == problems[0][1] else ()
            inspection.apply(FIRST_RULES, world, where)
            pure = inspection.apply(MEMORY_RULES, world, where)
            inspection.apply((*WORLD_RULES, *dear), world, where)
            pure &= inspection.apply(PURITY_RULES, world, where)
            if pure:
                inspection.apply(TWIN_RULES, world, where)
            inspection.apply(LAST_RULES, world, where)
            for stumble in world.errors:
                by_the_world = str(stumble).startswith(f"{type(env).__name__}.")
                (inspection.raised if by_the_world else inspection.stumbled)(stumble, where)
            if world.remade is not None:
                open_worlds = [other for other in open_worlds if other is not spare] + [world.remade]
            spare = world.remade or spare or twin
            open_worlds.remove(env)  # it was closed at last
            yield world
    finally:
        for env in open_worlds:
            try:
                env.close()
            except (Exception, SystemExit) as error:
                inspection.raised(error)


def _remark_on(worlds: Sequence[World], inspection: Inspection) -> None:
    """What could not be looked at in any of the worlds."""
    kinds = dict.fromkeys(schema.name for world in worlds for schema in _schemas(world))
    for name in kinds:
        trials = [trial for world in worlds for trial in world.trials if trial.action.name == name]
        if not any(trial.transition is not None for trial in trials):
            inspection.remark(f"None of {len(trials)} {name!r} actions that were tried could be carried out.")
        if not any(trial.failure for trial in trials):
            inspection.remark(f"None of {len(trials)} {name!r} actions that were tried was refused.")
    if any(problem.explain is NO_EXPLANATION for world in worlds for _, problem in world.queries):
        inspection.remark("A motion problem has no explain, so a planner cannot tell a model what is in the way.")
    if any(world.verified and world.result is None for world in worlds):
        inspection.remark("In some world no plan was found for the verifier to look at.")


def _schemas(world: World) -> tuple[ActionSchema, ...]:
    schemas = world.env.schemas
    return schemas if isinstance(schemas, tuple) else ()
