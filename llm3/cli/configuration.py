"""From the flags of a run to the run: a new one, or a recorded one again."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import fields
from pathlib import Path
from typing import Any

from llm3.assembly import Run, RunConfig, assemble
from llm3.cli.problem_arguments import chosen_domain, chosen_options, loaded_instance
from llm3.errors import UsageError
from llm3.records import RunFile, read_run, repeat
from llm3.records.repetition import REPLAY
from llm3.registry import Registry

CONFIGURATION = tuple(field.name for field in fields(RunConfig))
"""The flags that make a run what it is."""
_APART = ("llm", "options")


def assembled(registry: Registry, arguments: Namespace) -> Run:
    """The run that the flags ask for; without ``--domain``, the one whose folder is to be replayed.

    Args:
        registry: Where the names are looked up.
        arguments: The flags; those of `CONFIGURATION` that were not given are None.

    Raises:
        LLM3Error: A name is unknown, or a flag says something else than the record that it is given with.
    """
    given = _given(arguments)
    folder = _replayed_folder(given)
    if folder:
        _refuse_contradictions(arguments, given, read_run(folder), folder)
        return repeat(registry, folder)
    domain = chosen_domain(registry, arguments)
    instance, source = loaded_instance(domain, arguments), str(arguments.instance or "")
    return assemble(registry, RunConfig(**given), instance, source)


def _given(arguments: Namespace) -> dict[str, Any]:
    given = {name: getattr(arguments, name, None) for name in CONFIGURATION if name != "options"}
    given = {name: value for name, value in given.items() if value is not None}
    return {**given, "options": chosen_options(arguments)}


def _replayed_folder(given: dict[str, Any]) -> Path | None:
    name, _, argument = given.get("llm", "").partition(":")
    if name != REPLAY or "domain" in given or (argument and Path(argument).is_file()):
        return None
    if not argument:
        raise UsageError(f"the backend {REPLAY!r} needs the folder of a run: --llm {REPLAY}:runs/NAME.")
    return Path(argument)


def _refuse_contradictions(arguments: Namespace, given: dict[str, Any], recorded: RunFile, folder: Path) -> None:
    config = recorded.config
    asked = {_flag(name): (value, getattr(config, name)) for name, value in given.items() if name not in _APART}
    asked |= {f"-D {key}": (value, recorded.options.get(key)) for key, value in given["options"].items()}
    asked |= {"--instance": (arguments.instance, None)} if arguments.instance else {}
    for flag, (value, there) in asked.items():
        if value != there:
            has = f"has no {flag}" if there is None else f"has {_written(flag, there)}"
            raise UsageError(
                f"the recording '{folder}' {has}: leave out {_written(flag, value)}, "
                "or give --domain to replay it in another run."
            )


def _flag(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _written(flag: str, value: object) -> str:
    return f"{flag}={value}" if flag.startswith("-D") else f"{flag} {value}"
