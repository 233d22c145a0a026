"""What an experiment would do, before anything is done; whatever cannot work is told here, and not after an hour."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path

from llm3.assembly import prepare
from llm3.assembly.choices import settle_options
from llm3.experiments.experiment import Experiment, Job, ProblemFamily
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
    motion_calls: int
    """How many it may make; 0 for no limit."""
    notices: tuple[str, ...]
    """What the user should read before, of all problems."""
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
        notices: dict[str, None] = {}
        for problem in experiment.problems:
            config = experiment.config(method, problem, experiment.seeds[0])
            with prepare(registry, config) as prepared:
                plugins |= prepared.plugins
                most = prepared.config.max_motion_calls or 0
                notices |= dict.fromkeys([prepared.notice] if prepared.notice else [])
                outlook = MethodOutlook(prepared.language_model, most, tuple(notices), FrozenDict(plugins))
        found[method.name] = outlook
    return found


def settled(registry: Registry, experiment: Experiment) -> Experiment:
    """The same with what is in files in place of their names, where a domain's options name files.

    Raises:
        LLM3Error: There is no such domain, option or file.
    """
    return replace(experiment, problems=tuple(_settled(registry, problem) for problem in experiment.problems))


def _settled(registry: Registry, problem: ProblemFamily) -> ProblemFamily:
    if not problem.options:
        return problem
    options = settle_options(registry.domain(problem.domain), problem.options)
    return replace(problem, options={name: options[name] for name in problem.options})


def package_versions() -> Mapping[str, str]:
    """The packages here that a result depends on, on whichever machine it is made."""
    return {name: version for name, version in versions().items() if name not in MACHINE}


def versions_of(experiment: Experiment, outlooks: Iterable[MethodOutlook]) -> Mapping[str, str]:
    """What the results depend on: packages, the plugins that the methods use, and the files that backends read."""
    plugins = {name: origin for outlook in outlooks for name, origin in sorted(outlook.plugins.items())}
    return FrozenDict({**package_versions(), **plugins, **dict(_files(experiment))})


def _files(experiment: Experiment) -> Iterator[tuple[str, str]]:
    for method in experiment.methods:
        _, _, argument = str(method.settings.get("llm", "")).partition(":")
        if argument and Path(argument).is_file():
            yield f"file {argument}", sha256(Path(argument).read_bytes()).hexdigest()[:12]


@dataclass(frozen=True)
class Share:
    """What a method will do at most."""

    method: str
    runs: int
    calls: int
    """Answers of a model, or proposals of what stands in for one; 0 for a solver that asks nobody."""
    motion_calls: int
    """The motion calls of a solver that asks nobody; 0 where they have no limit."""
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
            sum(outlooks[name].motion_calls for _ in ours if ours[0].config.is_search),
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
