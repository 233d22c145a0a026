"""Runs on a Dask cluster, with a real one of this machine."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import CancelledError
from importlib import metadata
from pathlib import Path

import pytest
import worker_tasks as tasks
from command_line import environment, install_corridor, llm3, run
from dask_processes import dask, scheduler
from experiment_files import TOML, lines_of, without_times
from patience import eventually

from llm3.errors import LLM3Error, MissingDependency
from llm3.experiments.cluster import connect

HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def plugins(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of plugins, in which the corridor is."""
    folder = tmp_path_factory.mktemp("plugins")
    install_corridor(folder)
    return folder


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory, plugins: Path) -> Iterator[str]:
    """The address of a cluster of two processes."""
    folder, env = tmp_path_factory.mktemp("dask"), environment(plugins, HERE)
    with (
        scheduler(folder, env) as (_, address),
        dask(f"worker {address} --nthreads 1 --nworkers 2", folder / "workers.log", env),
    ):
        log = folder / "workers.log"
        eventually(lambda: log.read_text(encoding="utf-8").count("Registered to") == 2)
        yield address


def refusal(address: str, seconds: float = 10.0) -> str:
    """Why a cluster is of no use."""
    with pytest.raises(LLM3Error) as error, connect(address, seconds):
        pytest.fail("connected")
    return str(error.value)


def test_a_cluster_is_an_executor_with_a_slot_for_each_process(cluster, capfd):
    with connect(cluster) as (executor, slots):
        assert slots == 2
        futures = [executor.submit(tasks.echo, text) for text in ("a", "b", "a")]
        pids = [executor.submit(tasks.process, "") for _ in range(2)]
        assert [future.result(timeout=60) for future in futures] == ["a", "b", "a"]
        assert str(os.getpid()) not in [future.result(timeout=60) for future in pids]
        assert repr(executor.submit(tasks.refuse, "not this").exception(timeout=60)) == "ValueError('not this')"
    assert capfd.readouterr() == ("", "")


def test_nobody_at_the_address_is_one_line():
    with socket.socket() as bound:
        bound.bind(("127.0.0.1", 0))  # and does not listen
        address = f"tcp://127.0.0.1:{bound.getsockname()[1]}"
        assert refusal(address, seconds=0.5) == (
            f"no Dask scheduler answers at {address!r}: Timed out trying to connect to {address} after 0.5 s. Start "
            "one with 'dask scheduler', which tells its address."
        )


@pytest.mark.parametrize("address", ["", "nonsense", "127.0.0.1", "udp://127.0.0.1:9", "tcp://127.0.0.1:port"])
def test_what_is_no_address_is_one_line(address):
    sentence = "the address of a Dask scheduler is such as tcp://192.168.1.5:8786, not "
    assert refusal(address) == f"{sentence}{address!r}."


def test_without_the_package_the_sentence_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(MissingDependency) as error, connect("tcp://127.0.0.1:9"):
        pytest.fail("connected")
    assert str(error.value) == "runs on a Dask cluster need the package distributed: pip install 'llm3[dask]'."


@pytest.mark.slow
class TestRefusedWorkers:
    """Workers that would not do the same as this machine."""

    @pytest.fixture
    def empty(self, tmp_path) -> Iterator[str]:
        with scheduler(tmp_path, environment()) as (_, address):
            yield address

    def test_a_cluster_without_workers(self, empty):
        assert refusal(empty, seconds=0.5) == (
            f"the Dask cluster at {empty!r} has no workers: start some with 'dask worker {empty} --nthreads 1'."
        )

    def refused(self, folder: Path, scheduler: str, *flags: str) -> str:
        """Why a worker that has a folder of its own on its path is refused; it is called WORKER."""
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        line = f"worker {scheduler} --host 127.0.0.1 --worker-port {port} {' '.join(flags)}"
        with dask(line, folder / "worker.log", environment(folder / "path")):
            return refusal(scheduler, seconds=60).replace(f"tcp://127.0.0.1:{port}", "WORKER")

    def test_a_worker_with_threads(self, tmp_path, empty):
        assert self.refused(tmp_path, empty, "--nthreads", "3") == (
            "the Dask worker WORKER has 3 threads, and runs need one that has 1: start it with --nthreads 1 (and with "
            "--nworkers for as many processes)."
        )

    def test_a_worker_with_another_version(self, tmp_path, empty):
        info = tmp_path / "path/llm3-9.9.dist-info"
        info.mkdir(parents=True)
        (info / "METADATA").write_text("Metadata-Version: 2.1\nName: llm3\nVersion: 9.9\n", encoding="utf-8")
        assert self.refused(tmp_path, empty, "--nthreads", "1") == (
            f"the Dask worker WORKER has llm3 9.9, and this machine has {metadata.version('llm3')}: results may depend "
            "on it, so install the same."
        )

    def test_a_worker_without_llm3(self, tmp_path, empty):
        stub = tmp_path / "path/llm3/__init__.py"
        stub.parent.mkdir(parents=True)
        stub.write_text("raise ImportError('not here')\n", encoding="utf-8")
        told = self.refused(tmp_path, empty, "--nthreads", "1")
        assert told == "the Dask worker WORKER cannot load llm3: ImportError('not here')"


@pytest.mark.slow
def test_one_worker_two_workers_and_a_cluster_give_the_same_table(tmp_path, plugins, cluster):
    (tmp_path / "walks.toml").write_text(TOML.replace("attempts = 3", "attempts = 12"), encoding="utf-8")
    env, tables, lines = environment(plugins), [], []
    for name, flags in (("first", "--workers 1"), ("second", "--workers 2"), ("third", f"--dask {cluster}")):
        ended = run(llm3(f"experiment walks.toml --out {name} {flags} --quiet"), tmp_path, env)
        assert (ended.code, ended.err) == (0, "")
        lines.append(without_times(lines_of(tmp_path / name)))
        shown = run(llm3(f"results {name} --no-seconds"), tmp_path, env)
        assert shown.code == 0
        tables.append(shown.out.replace(name, "NAME"))
        assert len(list((tmp_path / name / "records").rglob("run.json"))) == 2 * 12
    assert len(lines[0]) == 2 * 12
    assert lines == [lines[0]] * 3
    assert tables == [tables[0]] * 3


@pytest.mark.slow
def test_a_run_that_ends_every_worker_is_given_up_and_the_cluster_lives(cluster):
    with connect(cluster) as (executor, _):
        assert type(executor.submit(tasks.end, "3").exception(timeout=120)).__name__ == "KilledWorker"
        assert executor.submit(tasks.echo, "on we go").result(timeout=60) == "on we go"


@pytest.mark.slow
def test_a_cluster_that_is_lost_ends_the_experiment_and_crashes_no_run(tmp_path, plugins):
    (tmp_path / "walks.toml").write_text(TOML.replace("attempts = 3", "attempts = 300"), encoding="utf-8")
    env, runs = environment(plugins), tmp_path / "out/runs.jsonl"
    with scheduler(tmp_path, env) as (process, address), dask(f"worker {address} --nthreads 1", tmp_path / "log", env):
        ours = subprocess.Popen(
            llm3(f"experiment walks.toml --out out --dask {address} --quiet --no-records"),
            cwd=tmp_path, env=env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        try:
            eventually(lambda: ours.poll() is not None or (runs.exists() and runs.read_bytes().count(b"\n") > 5))
            process.send_signal(signal.SIGKILL)
            eventually(lambda: ours.poll() is not None)
        finally:
            ours.kill()
            out, err = ours.communicate(timeout=60)
    assert (ours.returncode, out) == (3, ""), err
    assert err.startswith("llm3: error: "), err
    assert err.count("\n") == 1, err
    assert {line["status"] for line in lines_of(tmp_path / "out")} <= {"solved", "not solved"}


def test_what_was_submitted_is_cancelled_when_the_block_ends(cluster, tmp_path):
    with connect(cluster) as (executor, _):
        future = executor.submit(tasks.echo, str(tmp_path))
        future.result(timeout=60)
        waiting = [executor.submit(tasks.wait_for, str(tmp_path / name)) for name in "abc"]
        eventually(lambda: (tmp_path / "a").exists())
    for marker in tmp_path.iterdir():
        marker.unlink()
    for future in waiting:
        with pytest.raises(CancelledError):
            future.result(timeout=60)
