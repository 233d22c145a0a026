"""Experiments that are killed, interrupted and started again lose nothing and do nothing twice."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import psutil
import pytest
from command_line import llm3, run
from experiment_files import TOML, lines_of, without_times
from patience import all_gone, eventually, is_gone

FLAGS = "experiment walks.toml --workers 2 --quiet --out"

DEADLY = """
import os, signal, time
from pathlib import Path
from llm3 import LLMBackend, hookimpl
from llm3.types import Completion

class Deadly(LLMBackend):
    is_language_model = False

    def __init__(self, settings):
        self.run = settings.run

    def complete(self, request):
        if "/1/" in self.run:  # the seed
            DEATH
        return Completion("[]")

@hookimpl
def llm3_backends():
    return {"deadly": Deadly}
"""


def start(cwd: Path, surroundings: Mapping[str, str], out: str) -> subprocess.Popen[str]:
    """Start the experiment in a group of processes of its own, as a shell does."""
    heard = signal.signal(signal.SIGINT, signal.default_int_handler)  # a child inherits what is ignored
    try:
        return subprocess.Popen(
            llm3(f"{FLAGS} {out}"), cwd=cwd, env=surroundings,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
        )  # fmt: skip
    finally:
        signal.signal(signal.SIGINT, heard)


def finish(cwd: Path, surroundings: Mapping[str, str], out: str, code: int = 0) -> float:
    """Let the same command do the rest; the seconds that it took."""
    began = time.monotonic()
    ended = run(llm3(f"{FLAGS} {out}"), cwd, surroundings)
    assert (ended.code, ended.err) == (code, "")
    return time.monotonic() - began


def family(process: subprocess.Popen[str]) -> set[int]:
    """A process and all that came of it."""
    try:
        return {process.pid, *(child.pid for child in psutil.Process(process.pid).children(recursive=True))}
    except psutil.NoSuchProcess:
        return {process.pid}


def ended_runs(folder: Path) -> int:
    """How many lines there are by now, whole or not."""
    file = folder / "runs.jsonl"
    return file.read_bytes().count(b"\n") - 1 if file.exists() else 0


def table(cwd: Path, surroundings: Mapping[str, str], name: str) -> str:
    ended = run(llm3(f"results {name} --no-seconds"), cwd, surroundings)
    assert ended.code == 0
    return ended.out.replace(name, "NAME")


@pytest.mark.parametrize(
    ("attempts", "kills"), [(4, 2), pytest.param(100, 10, marks=pytest.mark.slow)], ids=["8 runs", "200 runs"]
)
def test_killed_again_and_again_it_ends_as_if_undisturbed(cwd, surroundings, attempts, kills):
    (cwd / "walks.toml").write_text(TOML.replace("attempts = 3", f"attempts = {attempts}"), encoding="utf-8")
    seconds = finish(cwd, surroundings, "undisturbed")
    there = []
    for moment in np.random.default_rng(8).uniform(0, 3 * seconds / kills, size=kills):
        process = start(cwd, surroundings, "killed")
        try:
            time.sleep(moment)
        finally:
            everybody = family(process)
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate(timeout=60)
        eventually(all_gone(everybody))
        there.append(ended_runs(cwd / "killed"))
    finish(cwd, surroundings, "killed")
    lines = lines_of(cwd / "killed")
    assert set(Counter(str(line["key"]) for line in lines).values()) == {1}
    assert len(lines) == 2 * attempts
    assert without_times(lines) == without_times(lines_of(cwd / "undisturbed"))
    if kills > 2:
        assert len({*there} - {0, 2 * attempts}) > 2  # it was killed in its midst, and went on from there
        assert table(cwd, surroundings, "killed") == table(cwd, surroundings, "undisturbed")


def deadly(cwd: Path, install, death: str, attempts: int = 4) -> None:
    """An experiment with one method, in which something befalls the run with seed 1."""
    install("llm3_deadly", DEADLY.replace("DEATH", death))
    head = TOML.partition("[[methods]]")[0].replace("attempts = 3", f"attempts = {attempts}")
    method = '[[methods]]\nname = "deadly"\nllm = "deadly"\nmax_llm_calls = 1\n'
    (cwd / "walks.toml").write_text(head + method, encoding="utf-8")


@pytest.mark.parametrize(
    ("death", "how"),
    [
        ("os.kill(os.getpid(), signal.SIGSEGV)", "was ended by SIGSEGV."),
        pytest.param("os._exit(7)", "ended with exit code 7.", marks=pytest.mark.slow),
    ],
)
def test_a_run_that_ends_its_process_is_a_line_and_the_rest_is_done(cwd, install, surroundings, death, how):
    deadly(cwd, install, death)
    finish(cwd, surroundings, "here", code=1)
    lines = {line["key"]["seed"]: line for line in lines_of(cwd / "here")}
    assert {seed: line["status"] for seed, line in lines.items()} == {
        0: "not solved", 1: "crashed", 2: "not solved", 3: "not solved",
    }  # fmt: skip
    assert lines[1]["error"] == f"WorkerDied: the worker process {how}"
    assert lines[1]["traceback"].startswith("Traceback")
    assert len(lines_of(cwd / "here")) == 4


@pytest.mark.slow
def test_a_worker_that_somebody_kills_costs_one_run(cwd, install, surroundings):
    deadly(cwd, install, "Path('pid').write_text(str(os.getpid())); time.sleep(600)")
    process = start(cwd, surroundings, "here")
    try:
        eventually(lambda: (cwd / "pid").exists() and (cwd / "pid").read_text(encoding="utf-8"))
        eventually(lambda: ended_runs(cwd / "here") == 3)
        os.kill(int((cwd / "pid").read_text(encoding="utf-8")), signal.SIGKILL)
        process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 1
    statuses = {line["key"]["seed"]: line["status"] for line in lines_of(cwd / "here")}
    assert statuses == {0: "not solved", 1: "crashed", 2: "not solved", 3: "not solved"}


@pytest.mark.parametrize(
    ("sent", "code", "said"),
    [
        (signal.SIGINT, 130, "llm3: interrupted."),
        pytest.param(signal.SIGTERM, 143, "llm3: terminated.", marks=pytest.mark.slow),
    ],
)
def test_ctrl_c_ends_it_at_once_and_the_same_command_does_the_rest(cwd, install, surroundings, sent, code, said):
    hanging = "Path('pid').write_text(str(os.getpid())); time.sleep(0 if Path('go on').exists() else 600)"
    deadly(cwd, install, hanging)
    process = start(cwd, surroundings, "here")
    try:
        eventually(lambda: (cwd / "pid").exists() and ended_runs(cwd / "here") == 3)
        everybody = family(process)
        os.killpg(process.pid, sent)  # as a terminal does, and a batch system
        out, err = process.communicate(timeout=60)
    finally:
        process.kill()
    eventually(all_gone(everybody))
    assert (process.returncode, out) == (code, "")
    assert err.splitlines()[-1] == said
    assert "Traceback" not in err
    assert len(lines_of(cwd / "here")) == 3
    (cwd / "go on").touch()
    finish(cwd, surroundings, "here")
    lines = lines_of(cwd / "here")
    assert {(line["key"]["seed"], line["status"]) for line in lines} == {(seed, "not solved") for seed in range(4)}
    assert len(lines) == 4


@pytest.mark.slow
def test_workers_do_not_outlive_a_command_that_was_killed(cwd, install, surroundings):
    deadly(cwd, install, "Path('pid').write_text(str(os.getpid())); time.sleep(600)")
    process = start(cwd, surroundings, "here")
    try:
        eventually(lambda: (cwd / "pid").exists() and ended_runs(cwd / "here") == 3)
        everybody = family(process)
    finally:
        process.kill()  # it alone
        process.communicate(timeout=60)
    assert is_gone(process.pid)
    eventually(all_gone(everybody))


def test_workers_that_do_not_start_end_the_experiment_and_crash_no_run(cwd, plugins, surroundings):
    (cwd / "walks.toml").write_text(TOML, encoding="utf-8")
    (plugins / "sitecustomize.py").write_text(
        "import os, sys\nif '--multiprocessing-fork' in sys.orig_argv: os._exit(9)\n", encoding="utf-8"
    )
    ended = run(llm3(f"{FLAGS} here"), cwd, surroundings)
    assert (ended.code, ended.out) == (3, "")
    assert ended.err == (
        "llm3: error: a worker process did not start: the worker process ended with exit code 9. A script that starts "
        'workers must do so below if __name__ == "__main__".\n'
    )
    assert lines_of(cwd / "here") == []
