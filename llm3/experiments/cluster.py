"""Runs on a Dask cluster, for when one machine is not enough."""

from __future__ import annotations

import logging
import re
from collections.abc import Iterator, Mapping
from concurrent.futures import Executor
from contextlib import contextmanager
from importlib import metadata
from typing import TYPE_CHECKING

from llm3.errors import LLM3Error, MissingDependency, UsageError
from llm3.experiments.outlook import package_versions
from llm3.records.run_file import VERSIONED

if TYPE_CHECKING:
    from distributed import Client

ADDRESS = re.compile(r"((tcp|tls|ws|wss)://)?([\w.-]+|\[[0-9a-fA-F:.%\w]+\]):\d{1,5}", re.ASCII)
"""Dask itself does not answer to some others before long, nor to what comes after them."""


@contextmanager
def connect(address: str, seconds: float = 10.0) -> Iterator[tuple[Executor, int]]:
    """The executor of a Dask cluster, and how many runs it does at once.

    Each worker process must have one thread: what PyBullet's worlds share in a process is not made for two, and a run
    that ends a process would take others with it.

    Args:
        address: Of the scheduler, such as ``tcp://192.168.1.5:8786``.
        seconds: How long to wait for an answer, and then for a worker.

    Raises:
        UsageError: It is no address.
        MissingDependency: Dask's package ``distributed`` is not installed.
        LLM3Error: Nobody answers, there is no worker, or a worker would not do the same as this machine.
    """
    try:
        from distributed import Client
    except ImportError as error:
        raise MissingDependency(
            "runs on a Dask cluster need the package distributed: pip install 'llm3[dask]'."
        ) from error
    if not ADDRESS.fullmatch(address):
        raise UsageError(f"the address of a Dask scheduler is such as tcp://192.168.1.5:8786, not {address!r}.")
    with _quiet():
        try:
            client = Client(address, timeout=seconds, set_as_default=False)
        except Exception as error:  # of whichever kind: that depends on how far it came
            reason = str(error) or type(error).__name__
            raise LLM3Error(
                f"no Dask scheduler answers at {address!r}: {reason}. Start one with 'dask scheduler', which tells its "
                "address."
            ) from error
        with client:
            slots = _checked(client, address, seconds)
            yield client.get_executor(pure=False), slots


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep the client from writing to stderr, where the progress is. What it says of a lost cluster, errors say."""
    loggers = [logging.getLogger(name) for name in ("distributed", "distributed.client")]
    before = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL)
    try:
        yield
    finally:
        for logger, level in zip(loggers, before, strict=True):
            logger.setLevel(level)


def installed_versions() -> Mapping[str, str]:
    """What decides results and is installed here: Python, the packages, and whatever brings plugins."""
    plugins = {point.dist.name: point.dist.version for point in metadata.entry_points(group="llm3") if point.dist}
    return {**plugins, **package_versions()}


def _checked(client: Client, address: str, seconds: float) -> int:
    """How many workers there are; all of them will do."""
    try:
        client.wait_for_workers(1, timeout=seconds)
    except TimeoutError:
        raise LLM3Error(
            f"the Dask cluster at {address!r} has no workers: start some with 'dask worker {address} --nthreads 1'."
        ) from None
    threads: dict[str, int] = client.nthreads()
    for worker, count in sorted(threads.items()):
        if count != 1:
            raise LLM3Error(
                f"the Dask worker {worker} has {count} threads, and runs need one that has 1: start it with "
                "--nthreads 1 (and with --nworkers for as many processes)."
            )
    here = installed_versions()
    for worker, there in sorted(client.run(installed_versions, on_error="return").items()):
        if isinstance(there, BaseException):
            raise LLM3Error(f"the Dask worker {worker} cannot load llm3: {there}")
        for name, version in here.items():
            if there.get(name, "not installed") != version and (name in there or name in VERSIONED):
                raise LLM3Error(
                    f"the Dask worker {worker} has {name} {there.get(name, 'nothing')}, and this machine has "
                    f"{version}: results may depend on it, so install the same."
                )
    return len(threads)
