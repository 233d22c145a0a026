"""The worker's side of an experiment: a text with a job comes in, a text with what came of it goes out."""

from __future__ import annotations

import threading
import traceback
from collections import Counter
from contextlib import ExitStack, suppress
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from time import perf_counter

from llm3.assembly import Run, prepare
from llm3.errors import LLM3Error, PluginError
from llm3.experiments.experiment import Job
from llm3.experiments.run_line import RunLine
from llm3.interfaces import Env
from llm3.jsonio import dumps, loads
from llm3.records import Recorder, create_folder
from llm3.records.tally import Tally
from llm3.registry import Registry
from llm3.types import Observer, Result, RunEvent


@dataclass(frozen=True)
class Assignment:
    """What a worker is sent."""

    job: Job
    record: str | None
    """The folder for the run's record, or None for no record."""


def work(text: str) -> str:
    """Do one run, in this process; see `Worker.work`."""
    return _worker(threading.get_ident()).work(text)


@cache
def _worker(_thread: int) -> Worker:
    """The worker of a thread. An executor gives a function no other place to keep the plugins and a world in."""
    return Worker(Registry.discover())


class Worker:
    """Does runs one after the other, in one world as long as the domain can make the next out of the last."""

    def __init__(self, registry: Registry) -> None:
        """Start without a world."""
        self._registry = registry
        self._spare: tuple[str, Env] | None = None
        """A world that is no longer needed, and its domain."""

    def work(self, text: str) -> str:
        """Do one run.

        Args:
            text: An `Assignment` as JSON.

        Returns:
            A `RunLine` as JSON. What goes wrong with the run stands there too.
        """
        return dumps(self.run(loads(text, Assignment, "an assignment")))

    def run(self, assignment: Assignment) -> RunLine:
        """Do one run, and tell what came of it, whatever that is."""
        job, tally = assignment.job, Tally()
        asked = False
        began = perf_counter()
        try:
            with ExitStack() as stack:
                run = stack.enter_context(self._open(job))
                asked = run.solver.language_model
                observers: list[Observer] = [tally]
                if assignment.record:
                    folder = create_folder(Path(assignment.record), force=True)
                    observers.append(stack.enter_context(Recorder(folder, run)))

                def observe(event: RunEvent) -> None:
                    for observer in observers:
                        observer(event)

                began = perf_counter()
                line = _line(job, run.solve(observe))
                self._spare = (run.problem.domain.name, run.release())
        except (Exception, SystemExit) as error:  # a mistake in one run must not cost the others
            line = _failed(job, error)
        seconds = round(perf_counter() - began, 3)
        return replace(line, stats=tally.stats, language_model=asked, model=tally.model, seconds=seconds)

    def close(self) -> None:
        """Let go of the world. Calling it twice does no harm."""
        spare, self._spare = self._spare, None
        if spare:
            with suppress(Exception):  # it has done its run, and the next one must not answer for it
                spare[1].close()

    def _open(self, job: Job) -> Run:
        prepared = prepare(self._registry, job.config)
        spare = None
        if self._spare and self._spare[0] == job.config.domain:
            (_, spare), self._spare = self._spare, None
        self.close()  # a world of another domain
        return prepared.open(spare=spare)


def _line(job: Job, result: Result) -> RunLine:
    kinds = Counter(attempt.failure.kind.value for attempt in result.attempts if attempt.failure)
    return RunLine(
        job.key,
        "solved" if result.solved else "not solved",
        stop=result.stop,
        iterations=len(result.attempts),
        plan_length=len(result.plan),
        failures=dict(sorted(kinds.items())),
        unmet=result.goal.unmet,
        time_limited=result.time_limited,
    )


def _failed(job: Job, error: BaseException) -> RunLine:
    if isinstance(error, LLM3Error) and not isinstance(error, PluginError):
        return RunLine(job.key, "error", error=str(error))
    if isinstance(error, OSError):  # plugins' own come as PluginError
        what = error.strerror or type(error).__name__
        return RunLine(job.key, "error", error=f"the record cannot be written: {what}.")
    told = str(error) if isinstance(error, LLM3Error) else f"{type(error).__name__}: {error}"
    return RunLine(job.key, "crashed", error=told, traceback="".join(traceback.format_exception(error)))
