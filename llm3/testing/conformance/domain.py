"""The check of a domain: makes worlds itself, and closes them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from time import perf_counter
from typing import Any

from llm3.errors import UnknownName
from llm3.interfaces import Domain
from llm3.registry import Registry
from llm3.testing.conformance import catalogue_rules, series_rules
from llm3.testing.conformance.catalogue_rules import Catalogue
from llm3.testing.conformance.complaint import Complaint, Report
from llm3.testing.conformance.domain_rules import INSTEAD
from llm3.testing.conformance.helpers import PLANNER, Helpers
from llm3.testing.conformance.inspection import Inspection
from llm3.testing.conformance.looking import Looker, Problem
from llm3.testing.conformance.remarks import remarks


@dataclass(frozen=True)
class Given:
    """A problem of the user's own."""

    where: str
    """What sentences about it begin with, such as a file's name."""
    instance: Any


def check_domain(
    domain: Domain,
    *,
    setting: str | None = None,
    seeds: Sequence[int] = (0, 1),
    registry: Registry | None = None,
    clock: Callable[[], float] = perf_counter,
) -> tuple[Complaint, ...]:
    """Look for faults in a domain and in its worlds, which it makes and closes itself.

    The whole test of a domain is ``assert check_domain(Corridor()) == ()``.

    Args:
        domain: The domain; its options stay at their defaults.
        setting: Which setting to look at; None: all of them.
        seeds: Which problems of each setting.
        registry: Where the planner and the strategies come from that its worlds are tried with; None: all that is
            installed.
        clock: Seconds: a world whose answers take long is asked fewer questions.

    Raises:
        UnknownName: The domain has no such setting.
    """
    found = Registry.discover() if registry is None else registry
    return examine_domain(domain, found, setting=setting, seeds=seeds, clock=clock).complaints


def examine_domain(
    domain: Domain,
    registry: Registry,
    *,
    setting: str | None = None,
    seeds: Sequence[int] = (0, 1),
    given: Given | None = None,
    clock: Callable[[], float] = perf_counter,
) -> Report:
    """Like :func:`check_domain`, with the remarks and with what was looked at.

    Args:
        domain: The domain.
        registry: Where the planner and the strategies come from that its worlds are tried with.
        setting: Which setting to look at; None: all of them.
        seeds: Which problems of each setting.
        given: A problem to look at in place of those of the settings and seeds.
        clock: Seconds: a world whose answers take long is asked fewer questions.

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
    problems = [
        Problem(f"{name}, seed {seed}", name, seed, partial(domain.instance, name, seed), dear=seed == seeds[0])
        for name in settings
        for seed in seeds
    ]
    if given is not None:
        problems = [Problem(given.where, "given", 0, lambda: given.instance, dear=True)]
    worlds = list(Looker(domain, helpers, inspection, clock).worlds(problems))
    inspection.apply(catalogue_rules.LAST_RULES, Catalogue(domain, settings))
    inspection.apply(series_rules.RULES, worlds)
    if not inspection.report.complaints:
        inspection.apply(series_rules.LAST_RULES, worlds)
    for remark in remarks(worlds):
        inspection.remark(remark)
    return inspection.report
