"""A Dask scheduler and its workers, started as a shell starts them."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from patience import eventually


@contextmanager
def dask(line: str, log: Path, env: Mapping[str, str]) -> Iterator[subprocess.Popen[bytes]]:
    """Run `dask LINE` (no quotes) until the block ends, which ends all of its processes."""
    with log.open("wb") as file:
        process = subprocess.Popen(
            [sys.executable, "-m", "dask", *line.split(), "--no-dashboard"],
            cwd=log.parent, env=env, stdin=subprocess.DEVNULL, stdout=file, stderr=file, start_new_session=True,
        )  # fmt: skip
    try:
        yield process
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait(timeout=60)


@contextmanager
def scheduler(folder: Path, env: Mapping[str, str]) -> Iterator[tuple[subprocess.Popen[bytes], str]]:
    """A scheduler, which has no workers, and its address."""
    told = folder / "scheduler.json"
    line = (
        f"scheduler --host 127.0.0.1 --port 0 --idle-timeout 600 --scheduler-file {told}"  # seconds, if all else fails
    )
    with dask(line, folder / "scheduler.log", env) as process:
        eventually(lambda: told.exists() and told.read_text(encoding="utf-8").endswith("}"))
        yield process, json.loads(told.read_text(encoding="utf-8"))["address"]
