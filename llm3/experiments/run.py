"""Runs what is missing of an experiment, as many runs at once as there is room for."""

from __future__ import annotations

import traceback
from collections import deque
from collections.abc import Callable, Mapping
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait

from llm3.errors import LLM3Error
from llm3.experiments.experiment import Experiment, Job, RunKey
from llm3.experiments.folder import record_folder
from llm3.experiments.run_line import RunLine
from llm3.experiments.schedule import Schedule
from llm3.experiments.work import Assignment, work
from llm3.experiments.writer import ExperimentWriter
from llm3.jsonio import dumps, loads

PATIENCE = 10
"""So many runs, one after the other, that end with the same error end the experiment."""

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
    experiment: Experiment,
    jobs: list[Job],
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
        experiment: What the jobs are of.
        jobs: What is to be done, in order.
        writer: Where the lines go; nobody else writes them.
        executor: Where runs are done. It gets a function and a text, and answers with a text.
        slots: How many runs at once it can do.
        limits: How many runs at once each provider of models takes; see `Schedule`.
        records: Whether the record of each run is kept, below the experiment's folder, where the run is done.
        watcher: Is told of each run that ended.
        work: What the executor is given to do, with an `Assignment` as JSON; it answers with a `RunLine` as JSON.

    Raises:
        LLM3Error: Many runs in a row ended with the same error.
    """
    schedule = Schedule(jobs, limits)
    running: dict[Future[str], Job] = {}
    errors: deque[str] = deque(maxlen=PATIENCE)
    try:
        while True:
            while len(running) < slots and (job := schedule.next()):
                folder = str(writer.folder.absolute() / record_folder(experiment, job.key)) if records else None
                running[executor.submit(work, dumps(Assignment(job, folder)))] = job
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                job = running.pop(future)
                schedule.ended(job)
                line = _line(job, future)
                writer.add(line)
                watcher(line)
                errors.append(line.error if line.status == "error" else "")
                if len(errors) == PATIENCE and line.error and set(errors) == {line.error}:
                    raise LLM3Error(f"the last {PATIENCE} runs ended with the same error: {line.error}")
    finally:
        for future in running:
            future.cancel()


def _line(job: Job, future: Future[str]) -> RunLine:
    """What a worker answered, or that it died over the job."""
    try:
        return loads(future.result(), RunLine, "the answer of a worker")
    except Exception as error:  # a worker that was killed, or a cluster that gave it up
        told = "".join(traceback.format_exception(error))
        return RunLine(job.key, "crashed", error=f"{type(error).__name__}: {error}", traceback=told)
