"""What an experiment would do, before anything is done; whatever cannot work is told here, and not after an hour."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from llm3.assembly import prepare
from llm3.experiments.experiment import Experiment, Job
from llm3.experiments.schedule import provider
from llm3.records.run_file import versions
from llm3.registry import Registry
from llm3.types import FrozenDict

MACHINE = ("platform",)
"""Versions that may differ between the workers of one experiment."""


@dataclass(frozen=True)
class MethodOutlook:
    """What is known of a method before it runs."""

    language_model: bool
    """Whether it asks one."""
    notice: str
    """What the user should read before, or nothing."""
    plugins: Mapping[str, str]
    """Where the plugins that it uses come from."""


def look_ahead(registry: Registry, experiment: Experiment) -> Mapping[str, MethodOutlook]:
    """Make everything that the methods need but worlds, once for each problem, and close it.

    Raises:
        LLM3Error: A name is unknown, a key is missing, or a problem lacks what a method needs.
    """
    found: dict[str, MethodOutlook] = {}
    for method in experiment.methods:
        plugins: dict[str, str] = {}
        for problem in experiment.problems:
            config = experiment.config(method, problem, experiment.seeds[0])
            with prepare(registry, config) as prepared:
                plugins |= prepared.plugins
                outlook = MethodOutlook(prepared.language_model, prepared.notice, FrozenDict(plugins))
        found[method.name] = outlook
    return found


def versions_of(outlooks: Iterable[MethodOutlook]) -> Mapping[str, str]:
    """What the results depend on: packages, and the plugins that the methods use."""
    packages = {name: version for name, version in versions().items() if name not in MACHINE}
    return FrozenDict({**packages, **{k: v for outlook in outlooks for k, v in sorted(outlook.plugins.items())}})


@dataclass(frozen=True)
class Share:
    """What a method will do at most."""

    method: str
    runs: int
    calls: int
    """Answers of a model, or proposals of what stands in for one; 0 where there is no such limit."""
    asked: str
    """The model, the stand-in, or the solver."""
    language_model: bool


def shares(experiment: Experiment, jobs: Iterable[Job], outlooks: Mapping[str, MethodOutlook]) -> tuple[Share, ...]:
    """What these jobs will do at most, by method."""
    by_method: dict[str, list[Job]] = {method.name: [] for method in experiment.methods}
    for job in jobs:
        by_method[job.key.method].append(job)
    return tuple(
        Share(
            name,
            len(ours),
            sum(0 if job.config.is_search else job.config.max_llm_calls for job in ours),
            _asked(ours[0]),
            outlooks[name].language_model,
        )
        for name, ours in by_method.items()
        if ours
    )


def providers(experiment: Experiment) -> tuple[str, ...]:
    """Whom the methods ask."""
    configs = (experiment.config(m, experiment.problems[0], experiment.seeds[0]) for m in experiment.methods)
    return tuple(sorted({provider(config) for config in configs} - {""}))


def _asked(job: Job) -> str:
    config = job.config
    return config.solver if config.is_search else config.model or config.backend
