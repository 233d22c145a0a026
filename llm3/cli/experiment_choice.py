"""From the flags of `llm3 experiment` to the experiment that is meant."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from pathlib import Path

from llm3.cli.problem_arguments import pair, seed
from llm3.errors import InputError, UnknownName, UsageError
from llm3.experiments import Experiment, experiment_of, overridden, parse_toml, providers
from llm3.jsonio import dumps
from llm3.registry import Registry


def add_choice_arguments(parser: ArgumentParser) -> None:
    """Add the arguments that say what is run."""
    add = parser.add_argument
    add("experiment", metavar="EXPERIMENT", help="the name of one that is there, such as table1, or a .toml file")
    add("--model", metavar="NAME", action="append", default=[], help="the language model; two are compared")
    add(
        "--llm",
        metavar="NAME",
        help="the backend of methods that name none (default: offline, no language model)",
    )
    add("--attempts", metavar="N", help="how many seeds")
    add("--seed", type=seed, metavar="N", help="the first of them")
    add("--method", metavar="NAME", action="append", default=[], help="only this one; may be given several times")
    add("--problem", metavar="NAME", action="append", default=[], help="only this one; may be given several times")
    add(
        "--set",
        dest="assignments",
        metavar="FIELD=VALUE",
        type=partial(pair, form="FIELD=VALUE"),
        action="append",
        default=[],
        help="set any other field, such as run.max_llm_calls=5; may be given several times",
    )


def chosen_experiment(registry: Registry, arguments: Namespace) -> Experiment:
    """The experiment of the flags, all of it.

    Raises:
        LLM3Error: There is none of this name, or its file or a flag says what cannot be.
    """
    name: str = arguments.experiment
    text = _read(Path(name)) if name.endswith(".toml") else registry.experiment(name)
    experiment = experiment_of(overridden(parse_toml(text, name), list(_assignments(arguments))), name)
    for flag, given in (("model", arguments.model), ("llm", [arguments.llm] if arguments.llm else [])):
        used = {method.settings.get(flag) for method in experiment.methods}
        if given and not used & set(given):
            raise UsageError(f"every method of {experiment.name!r} has a backend of its own: leave out --{flag}.")
    return experiment


def chosen_part(experiment: Experiment, arguments: Namespace) -> Experiment:
    """The methods and problems that are to be run.

    Raises:
        UnknownName: There is none of a name.
    """
    return experiment.only(tuple(arguments.method), tuple(arguments.problem))


def chosen_limits(experiment: Experiment, given: Iterable[tuple[str, int]]) -> Mapping[str, int]:
    """How many runs at once each provider takes.

    Raises:
        UnknownName: No method asks a provider of this name.
    """
    limits, known = dict(given), providers(experiment)
    for name in limits:
        if name not in known:
            raise UnknownName("provider", name, known, owner=f"experiment {experiment.name!r}")
    return limits


def _assignments(arguments: Namespace) -> Iterator[tuple[str, str]]:
    """What flags set, as fields and TOML values."""
    if arguments.model:
        yield "run.model", dumps(arguments.model if len(arguments.model) > 1 else arguments.model[0])
    if arguments.llm is not None:
        yield "run.llm", dumps(arguments.llm)
    if arguments.attempts is not None:
        yield "attempts", str(arguments.attempts)
    if arguments.seed is not None:
        yield "first_seed", str(arguments.seed)
    yield from arguments.assignments


def _read(file: Path) -> str:
    try:
        return file.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise InputError(f"{file}: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{file}: not UTF-8 text: {error.reason} at byte {error.start}") from error
