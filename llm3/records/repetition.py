"""A recorded run once more, from its record alone."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from llm3.assembly import Run, RunConfig, assemble
from llm3.jsonio import dumps, loads
from llm3.records.run_file import RunFile, read_run
from llm3.registry import Registry

REPLAY = "replay"
"""The backend that answers from a record."""


def repeat(registry: Registry, folder: Path) -> Run:
    """Make a recorded run ready to be solved again, with the replies of its record in place of a model.

    What was asked stands in the record: problem, options, method, seed and budget. A limit in seconds is left out,
    since no time passes with a model; where it ended the run, the recording ends it in the same place. A search has no
    replies: it is made again with all that it was asked, by its seed.

    Args:
        registry: Where the names are looked up.
        folder: The run's folder.

    Raises:
        LLM3Error: The record is not as documented, or names something that is not there.
    """
    recorded = read_run(folder)
    domain = registry.domain(recorded.config.domain)
    source = f"{folder / 'run.json'}, instance"
    instance = loads(dumps(recorded.instance), domain.instance_type, source)
    return assemble(registry, _configuration(recorded, folder), instance, source)


def _configuration(recorded: RunFile, folder: Path) -> RunConfig:
    if recorded.config.is_search:
        return replace(recorded.config, options=recorded.options)
    return replace(recorded.config, llm=f"{REPLAY}:{folder}", options=recorded.options, max_seconds=None)
