"""Plan for one problem: a model proposes, a motion planner tries, and what failed goes back to the model."""

from __future__ import annotations

import os
from argparse import ArgumentParser, Namespace
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from datetime import datetime
from pathlib import Path
from typing import TextIO

from llm3.assembly import Problem, RunConfig
from llm3.cli.configuration import CONFIGURATION, assembled
from llm3.cli.problem_arguments import (
    add_problem_arguments,
    add_prompt_arguments,
    add_world_arguments,
    path,
)
from llm3.cli.text import emit
from llm3.errors import OutputExists, UsageError
from llm3.jsonio import dumps
from llm3.playback import Live, open_window
from llm3.prices import read_prices
from llm3.records import CassetteRecorder, Recorder, check_cassette, create_default_folder, create_folder
from llm3.registry import Registry
from llm3.search import MOTION_CALLS
from llm3.timing import unknown_limits
from llm3.types import Observer, Result, RunEvent, nobody

_DEFAULT = RunConfig(domain="")


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    parser.add_argument("--version", action="version", version=_version())
    add_problem_arguments(parser)
    add_world_arguments(parser)
    add_prompt_arguments(parser)
    add = parser.add_argument
    add(
        "--feedback",
        metavar="NAME",
        default=_DEFAULT.feedback,
        help=f"what the model hears of failures (default: {_DEFAULT.feedback})",
    )
    add(
        "--solver",
        metavar="NAME",
        default=_DEFAULT.solver,
        help=f"loop, which asks a model, or search, which asks none (default: {_DEFAULT.solver})",
    )
    add("--llm", metavar="NAME", help="the backend (default: offline, which is no language model)")
    add("--model", metavar="NAME", help="the language model; implies --llm http")
    add("--temperature", type=float, metavar="T", help="sent to the model only if given")
    add("--max-reply-tokens", type=int, metavar="N", help="what the model may write in one reply (default: its own)")
    add(
        "--planner",
        metavar="NAME",
        default=_DEFAULT.planner,
        help=f"the motion planner (default: {_DEFAULT.planner})",
    )
    add(
        "--planner-iterations",
        type=int,
        metavar="N",
        default=_DEFAULT.planner_iterations,
        help=f"the planner's budget for one query (default: {_DEFAULT.planner_iterations})",
    )
    add(
        "--planner-seconds",
        type=float,
        metavar="S",
        default=_DEFAULT.planner_seconds,
        help=f"a guard on one query; a run that hits it may not repeat (default: {_DEFAULT.planner_seconds:g})",
    )
    add(
        "--timing",
        metavar="NAME",
        help="what puts times to the plan's motions, or none (default: toppra if it is installed)",
    )
    add(
        "--max-llm-calls",
        type=int,
        metavar="N",
        default=_DEFAULT.max_llm_calls,
        help=f"the budget (default: {_DEFAULT.max_llm_calls})",
    )
    add(
        "--trace-size",
        type=int,
        metavar="K",
        default=_DEFAULT.trace_size,
        help=f"how many earlier attempts a prompt tells of (default: {_DEFAULT.trace_size})",
    )
    add("--max-tokens-total", type=int, metavar="N", help="no call after so many tokens, read and written")
    add("--max-seconds", type=float, metavar="S", help="no call after so long, and none takes longer")
    add(
        "--max-motion-calls",
        type=int,
        metavar="N",
        help=f"no plan is tried after so many motion calls (default: no limit; of a search {MOTION_CALLS})",
    )
    add(
        "--record", type=path, metavar="FILE", help="keep every exchange with the model in a new file, for --llm replay"
    )
    add("--prices", type=path, metavar="FILE", help="what the model's tokens cost, to tell what the run did")
    add("--out", type=path, metavar="DIR", help="where the record goes (default: a new folder under runs/)")
    add("--force", action="store_true", help="overwrite the record in DIR, and FILE")
    add("--gui", action="store_true", help="open the domain's window")
    add("--json", action="store_true", help="print one JSON object instead of the plan")
    add("--quiet", action="store_true", help="no progress on stderr")
    parser.set_defaults(**dict.fromkeys(CONFIGURATION))  # a flag that is not given says nothing


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command: 0 solved, 1 not solved."""
    from llm3.cli.view import RunView  # rich takes a while to import

    _check_places(arguments)
    prices = read_prices(arguments.prices) if arguments.prices else {}
    registry = Registry.discover()
    with assembled(registry, arguments) as ready, _screen(ready.problem, arguments.gui) as screen:
        config = ready.config
        if config.is_search and arguments.record:
            raise UsageError("a search asks no model, so --record would keep nothing: leave it out.")
        view = RunView(quiet=arguments.quiet, budget=None if config.is_search else config.max_llm_calls)
        name = f"{config.domain}-{config.setting or 'instance'}-{config.seed}"
        if arguments.out:
            folder = create_folder(arguments.out, arguments.force)
        else:
            folder = create_default_folder(name, datetime.now())
        if ready.solver.notice:
            view.note(ready.solver.notice)
        for broken in registry.broken:
            view.note(f"warning: plugin {broken.plugin} failed to load: {broken.reason}")
        reason = unknown_limits(ready.problem.env.joints) if ready.timer else ""
        if reason and (arguments.timing or ready.problem.env.joints):
            view.note(f"the plan will have no times: {reason}.")
        with ExitStack() as stack:
            tape: Observer = nobody
            if arguments.record:
                tape = stack.enter_context(CassetteRecorder(arguments.record, ready, arguments.force))
            record = stack.enter_context(Recorder(folder, ready))
            stack.enter_context(view)

            def observe(event: RunEvent) -> None:
                for observer in (record, tape, view, screen):
                    observer(event)

            result = ready.solve(observe)
        price = prices.get(config.model or "")
        cost = price.of(result.stats) if price else None
        view.summary(result, record.seconds, folder, cost)
        if config.max_tokens_total and not result.stats.tokens:
            view.note("no tokens were counted: the model's server tells of none, so --max-tokens-total did nothing")
        if ready.solver.last_words:
            view.note(ready.solver.last_words)
        if arguments.json:
            emit(dumps(_summary(config, result, record.seconds, folder, cost)) + "\n", out)
        else:
            emit("".join(f"{step.action}\n" for step in result.plan), out)
        return 0 if result.solved else 1


@contextmanager
def _screen(problem: Problem, gui: bool) -> Iterator[Observer]:
    """What shows the run in a window, if that is asked for."""
    if not gui:
        yield nobody
        return
    with Live(open_window(problem.domain, problem.instance, problem.options)) as live:
        yield live


def _check_places(arguments: Namespace) -> None:
    """See that what is to be written overwrites nothing but an earlier result."""
    _, _, source = (arguments.llm or "").partition(":")
    for flag, place in (("--record", arguments.record), ("--out", arguments.out)):
        if source and place and Path(source).resolve() == place.resolve():
            raise OutputExists(f"'{place}' is what is replayed: give another {flag}.")
    if arguments.record:
        check_cassette(arguments.record, arguments.force)


def _summary(config: RunConfig, result: Result, seconds: float, folder: Path, cost: float | None) -> dict[str, object]:
    return {
        "solved": result.solved,
        "stop": result.stop,
        "domain": config.domain,
        "setting": config.setting,
        "seed": config.seed,
        "solver": config.solver,
        "strategy": None if config.is_search else config.strategy,
        "feedback": None if config.is_search else config.feedback,
        "llm": config.llm,
        "model": config.model,
        "planner": config.planner,
        "llm_calls": result.stats.llm_calls,
        "motion_calls": result.stats.motion_calls,
        "reused_actions": result.stats.reused_actions,
        "prompt_tokens": result.stats.prompt_tokens,
        "completion_tokens": result.stats.completion_tokens,
        "cost": cost,
        "seconds": round(seconds, 3),
        "plan": [str(step.action) for step in result.plan],
        "out": os.fsencode(folder).decode(errors="replace"),
    }


def _version() -> str:
    from importlib import metadata

    try:
        return f"llm3 {metadata.version('llm3')}"
    except metadata.PackageNotFoundError:
        return "llm3, not installed"
