"""Runs what is missing of an experiment, as many runs at once as there is room for."""

from __future__ import annotations

import traceback
from collections import defaultdict, deque
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import FIRST_COMPLETED, CancelledError, Executor, Future, wait
from functools import partial

from llm3.errors import LLM3Error
from llm3.experiments.experiment import Experiment, Job, RunKey
from llm3.experiments.folder import record_folder
from llm3.experiments.run_line import RunLine
from llm3.experiments.schedule import Schedule
from llm3.experiments.work import Assignment, work
from llm3.experiments.writer import ExperimentWriter
from llm3.jsonio import dumps, loads

PATIENCE = 10
"""So many runs of one method, one after the other, that end with the same error end the experiment."""

Watcher = Callable[[RunLine], None]
"""Is told of each run that ended."""


def missing_jobs(experiment: Experiment, ended: Mapping[RunKey, RunLine], retry: bool = False) -> list[Job]:
    """The runs that are still to be done, in order.

    Args:
        experiment: What is asked.
        ended: What was done already.
        retry: Whether runs that ended with an error or a crash are to be done again.
    """
    done = {key for key, line in ended.items() if not (retry and line.failed)}
    return [job for job in experiment.jobs() if job.key not in done]


def run_experiment(
    jobs: Iterable[Job],
    writer: ExperimentWriter,
    executor: Executor,
    slots: int,
    *,
    limits: Mapping[str, int],
    records: bool = True,
    watcher: Watcher,
    work: Callable[[str], str] = work,
) -> None:
    """Do these runs. Whatever ends this, the lines of the runs that ended are in the folder.

    Args:
        jobs: What is to be done, in order.
        writer: Where the lines go; nobody else writes them.
        executor: Where runs are done. It gets a function and a text, and answers with a text.
        slots: How many runs at once it can do.
        limits: How many runs at once each provider of models takes; see `Schedule`.
        records: Whether the record of each run is kept, below the experiment's folder, where the run is done.
        watcher: Is told of each run that ended.
        work: What the executor is given to do, with an `Assignment` as JSON; it answers with a `RunLine` as JSON.

    Raises:
        LLM3Error: Many runs of a method in a row ended with the same error, or no worker can do any run.
    """
    schedule = Schedule(jobs, limits)
    running: dict[Future[str], Job] = {}
    recent: defaultdict[str, deque[str]] = defaultdict(partial(deque, maxlen=PATIENCE))

    def keep(future: Future[str]) -> None:
        job = running[future]
        line = _line(job, future)
        writer.add(line)
        del running[future]
        schedule.ended(job)
        watcher(line)
        recent[job.key.method].append(line.error if line.status == "error" else "")

    try:
        while True:
            while len(running) < slots and (job := schedule.next()):
                folder = str(writer.folder.absolute() / record_folder(job.key)) if records else None
                running[executor.submit(work, dumps(Assignment(job, folder)))] = job
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                keep(future)
            for method, errors in recent.items():
                if len(errors) == PATIENCE and errors[0] and len(set(errors)) == 1:
                    raise LLM3Error(f"the last {PATIENCE} runs of {method!r} ended with the same error: {errors[0]}")
    finally:
        for future in list(running):
            if not future.cancel() and future.done() and not _is_lost(future):
                keep(future)


def _is_lost(future: Future[str]) -> bool:
    """Whether nobody did the work, as opposed to somebody who died over it."""
    return future.cancelled() or isinstance(future.exception(), LLM3Error)


def _line(job: Job, future: Future[str]) -> RunLine:
    """What a worker answered, or that it died over the job."""
    try:
        return loads(future.result(), RunLine, "the answer of a worker")
    except LLM3Error:  # no worker can do any run
        raise
    except CancelledError:
        raise LLM3Error("the workers were lost: the same command goes on with the rest.") from None
    except Exception as error:  # a worker that was killed, or a cluster that gave it up
        *_, last = str(error).strip().splitlines() or [""]
        told = "".join(traceback.format_exception(error))
        return RunLine(job.key, "crashed", error=f"{type(error).__name__}: {last}", traceback=told)
