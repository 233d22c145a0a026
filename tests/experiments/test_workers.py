"""Worker processes: each answers for its own work, and none outlives the process that started it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from concurrent.futures import CancelledError, Future
from pathlib import Path

import psutil
import pytest
import worker_tasks as tasks
from hypothesis import example, given, settings
from hypothesis import strategies as st
from patience import all_gone, eventually, written

from llm3.errors import LLM3Error, UsageError
from llm3.experiments.worker_process import WorkerDied, WorkFailed
from llm3.experiments.workers import SpawnedWorkers

HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def workers() -> Iterator[SpawnedWorkers]:
    with SpawnedWorkers(2) as two:
        yield two


def ending(future: Future[str]) -> str:
    """What came of some work, as one text."""
    error = future.exception(timeout=60)
    return future.result() if error is None else f"{type(error).__name__}: {str(error).splitlines()[-1]}"


WORK = {
    ("echo", "some text"): "some text",
    ("echo", "µ\n\0"): "µ\n\0",
    ("refuse", "not this"): "WorkFailed: ValueError: not this",
    ("leave", "by the door"): "WorkFailed: SystemExit: by the door",
    ("end", "3"): "WorkerDied: the worker process ended with exit code 3.",
    ("end", "0"): "WorkerDied: the worker process ended with exit code 0.",
    ("die", "SIGSEGV"): "WorkerDied: the worker process was ended by SIGSEGV.",
    ("die", "SIGKILL"): "WorkerDied: the worker process was ended by SIGKILL, as the system does when memory runs out.",
    ("die", "SIGINT"): "still alive",
}
"""Work, and what comes of it."""


@settings(max_examples=2)
@given(st.lists(st.sampled_from(list(WORK)), max_size=4))
@example(list(WORK))
def test_each_answers_for_its_own_work_whatever_becomes_of_others(workers, chosen):
    futures = [workers.submit(getattr(tasks, name), text) for name, text in chosen]
    assert [ending(future) for future in futures] == [WORK[work] for work in chosen]


def test_they_are_spawned_and_there_are_so_many(workers, tmp_path):
    markers = [tmp_path / "one", tmp_path / "two"]
    futures = [workers.submit(tasks.wait_for, str(marker)) for marker in markers]
    processes = written(*markers)
    third = workers.submit(tasks.process, "")
    assert len({*processes, os.getpid()}) == 3
    assert not third.running()
    markers[0].unlink()
    assert int(third.result(timeout=60)) == processes[0]  # which lives on and has kept what it imported
    markers[1].unlink()
    assert [future.result(timeout=60) for future in futures] == [str(marker) for marker in markers]
    assert workers.submit(tasks.how_started, "").result(timeout=60) == "spawn"


def test_a_worker_that_died_without_work_is_nobodys_loss():
    with SpawnedWorkers(1) as one:
        process = int(one.submit(tasks.process, "").result(timeout=60))
        os.kill(process, signal.SIGKILL)
        eventually(all_gone([process]))
        assert int(one.submit(tasks.process, "").result(timeout=60)) != process


def test_what_cannot_be_sent_or_answered_fails_alone(workers):
    assert "pickle" in str(workers.submit(lambda text: text, "").exception(timeout=60))
    assert isinstance(workers.submit(tasks.unspeakable, "").exception(timeout=60), WorkFailed)
    assert workers.submit(tasks.echo, "on we go").result(timeout=60) == "on we go"
    with pytest.raises(TypeError, match=r"^a worker's function takes positional arguments only.$"):
        workers.submit(tasks.echo, text="")


@pytest.mark.parametrize("count", [0, -1])
def test_there_must_be_a_worker(count):
    with pytest.raises(UsageError) as error:
        SpawnedWorkers(count)
    assert str(error.value) == f"the number of workers must be at least 1, not {count}."


def test_leaving_waits_for_the_work_and_nothing_is_left():
    us, threads = psutil.Process(), threading.active_count()
    with SpawnedWorkers(1) as first:
        first.submit(tasks.echo, "").result(timeout=60)  # the standard library's helper process is there from now on
    before = us.num_fds(), len(us.children(recursive=True))
    with SpawnedWorkers(2) as workers:
        futures = [workers.submit(tasks.echo, str(number)) for number in range(9)]
        workers.submit(tasks.end, "1")
    assert [future.result(timeout=0) for future in futures] == [str(number) for number in range(9)]
    assert (us.num_fds(), len(us.children(recursive=True)), threading.active_count()) == (*before, threads)
    with pytest.raises(RuntimeError, match=r"^the workers were shut down.$"):
        workers.submit(tasks.echo, "too late")
    workers.shutdown()
    workers.stop()


@pytest.mark.parametrize("busy", [pytest.param("sleep", marks=pytest.mark.slow), "compute"])
def test_stopping_ends_what_runs_and_cancels_what_waits(tmp_path, busy):
    workers = SpawnedWorkers(2)
    markers = [tmp_path / "one", tmp_path / "two"]
    futures = [workers.submit(getattr(tasks, busy), str(marker)) for marker in markers]
    processes = written(*markers)
    waiting = workers.submit(tasks.echo, "")
    workers.stop()
    assert all_gone(processes)()
    assert {ending(future) for future in futures} == {"WorkerDied: the workers were stopped."}
    with pytest.raises(CancelledError):
        waiting.result(timeout=0)


def test_stopping_while_they_start_ends_them_too():
    for count in (1, 2):
        workers = SpawnedWorkers(count)
        futures = [workers.submit(tasks.echo, "") for _ in range(4)]
        workers.stop()
        for future in futures:
            assert future.cancelled() or isinstance(future.exception(), WorkerDied)


def test_leaving_by_an_exception_stops_them(tmp_path):
    def interrupted() -> None:
        with SpawnedWorkers(1) as workers:
            workers.submit(tasks.sleep, str(tmp_path / "one"))
            processes.extend(written(tmp_path / "one"))
            raise KeyboardInterrupt

    processes: list[int] = []
    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert all_gone(processes)()


def test_work_can_be_cancelled_before_it_begins(tmp_path):
    with SpawnedWorkers(1) as workers:
        marker = tmp_path / "one"
        workers.submit(tasks.wait_for, str(marker))
        written(marker)
        waiting = workers.submit(tasks.wait_for, str(tmp_path / "two"))
        assert waiting.cancel()
        marker.unlink()
    assert not (tmp_path / "two").exists()


# What other processes see of it.

SCRIPT = """
import signal, sys, worker_tasks as tasks
from pathlib import Path
from llm3.experiments.workers import SpawnedWorkers

def main(busy, *markers):
    with SpawnedWorkers(3) as workers:
        first = workers.submit(tasks.process, "").result()
        Path(markers[0]).write_text(first, encoding="utf-8")
        futures = [workers.submit(getattr(tasks, busy), marker) for marker in markers[1:]]
        print([future.result() for future in futures])

if __name__ == "__main__":
    main(*sys.argv[1:])
"""


def started(folder: Path, busy: str, markers: list[Path], before: str = "") -> subprocess.Popen[str]:
    """A script with three workers, one of which has no work, in a group of processes of its own."""
    script = folder / "script.py"
    script.write_text(before + SCRIPT, encoding="utf-8")
    return subprocess.Popen(
        [sys.executable, "-W", "error", str(script), busy, *map(str, markers)],
        env={**os.environ, "PYTHONPATH": str(HERE)},
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("sent", "busy"),
    [
        (signal.SIGKILL, "compute"),
        pytest.param(signal.SIGKILL, "sleep", marks=pytest.mark.slow),
        pytest.param(signal.SIGTERM, "compute", marks=pytest.mark.slow),
        pytest.param(signal.SIGTERM, "sleep", marks=pytest.mark.slow),
    ],
)
def test_idle_and_busy_workers_end_with_their_parent(tmp_path, busy, sent):
    markers = [tmp_path / name for name in ("idle", "one", "two")]
    parent = started(tmp_path, busy, markers)
    try:
        family = {*written(*markers), *(child.pid for child in psutil.Process(parent.pid).children(recursive=True))}
        parent.send_signal(sent)
        parent.communicate(timeout=60)
        eventually(all_gone(family))
    finally:
        parent.kill()
    assert parent.returncode == -sent


@pytest.mark.slow
def test_ctrl_c_is_the_parents_business(tmp_path):
    ignoring = (
        "import signal\n"
        "ours = __name__ == '__main__'\n"
        "signal.signal(signal.SIGINT, signal.SIG_IGN if ours else signal.default_int_handler)\n"
    )
    markers = [tmp_path / name for name in ("idle", "one", "two")]
    parent = started(tmp_path, "wait_for", markers, before=ignoring)
    try:
        eventually(lambda: len(psutil.Process(parent.pid).children()) > 1)
        while not all(marker.exists() for marker in markers):  # while they start, too
            os.killpg(parent.pid, signal.SIGINT)
            assert parent.poll() is None
        for marker in markers:
            marker.unlink()
        out, err = parent.communicate(timeout=60)
    finally:
        parent.kill()
    assert (parent.returncode, out, err) == (0, f"{[str(marker) for marker in markers[1:]]}\n", "")


def run_script(folder: Path, text: str) -> subprocess.CompletedProcess[str]:
    script = folder / "script.py"
    script.write_text(text, encoding="utf-8")
    return subprocess.run(
        [sys.executable, "-W", "error", str(script)],
        env={**os.environ, "PYTHONPATH": str(HERE)}, capture_output=True, text=True, timeout=60,
    )  # fmt: skip


def test_what_they_print_is_not_taken_for_a_result(tmp_path):
    guarded = "    print(SpawnedWorkers(1).submit(tasks.say, 'hello').result())\n"
    done = run_script(tmp_path, SCRIPT.replace("    main(*sys.argv[1:])\n", guarded))  # and nobody shuts it down
    assert (done.returncode, done.stdout) == (0, "hello\n")
    assert done.stderr == "hello\nhello from native code\n"


def test_a_script_without_the_main_guard_is_told_of_it(tmp_path):
    done = run_script(
        tmp_path,
        "import worker_tasks as tasks\n"
        "from llm3.experiments.workers import SpawnedWorkers\n"
        "with SpawnedWorkers(1) as workers:\n"
        "    futures = [workers.submit(tasks.echo, str(number)) for number in range(9)]\n"
        "    print([future.result() for future in futures])\n",
    )
    assert (done.returncode, done.stdout) == (1, "")
    told = [line for line in done.stderr.splitlines() if line.startswith("llm3.errors.LLM3Error")]
    reasons = (  # of the worker, which was about to start workers itself, and of the script
        "An attempt has been made to start a new process before the current process has finished its bootstrapping "
        "phase",
        "the worker process ended with exit code 1",
    )
    assert told == [f"llm3.errors.LLM3Error: {no_start(reason)}" for reason in reasons]


def no_start(reason: str) -> str:
    return (
        f"a worker process did not start: {reason}. A script that starts workers must do so below "
        'if __name__ == "__main__".'
    )


def test_workers_that_cannot_start_fail_everything_at_once(monkeypatch):
    def full(*_: object) -> None:
        raise OSError("no room for another process")

    monkeypatch.setattr("llm3.experiments.worker_process.resource_tracker.ensure_running", full)
    with SpawnedWorkers(2) as workers:
        errors = [workers.submit(tasks.echo, "").exception(timeout=60) for _ in range(5)]
    assert {(type(error), str(error)) for error in errors} == {(LLM3Error, no_start("no room for another process"))}
