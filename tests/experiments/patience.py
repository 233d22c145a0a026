"""Waiting for what happens in other processes."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from pathlib import Path

import psutil

LIMIT = 60
"""Seconds after which a test gives up: no measure of anything."""


def eventually(happened: Callable[[], object]) -> None:
    """Wait until something is true."""
    began = time.monotonic()
    while not happened():
        assert time.monotonic() - began < LIMIT, "it never happened"
        time.sleep(0.005)


def written(*markers: Path) -> list[int]:
    """Wait for numbers, each of which somebody writes into a file."""
    eventually(lambda: all(marker.exists() and marker.read_text(encoding="utf-8") for marker in markers))
    return [int(marker.read_text(encoding="utf-8")) for marker in markers]


def is_gone(process: int) -> bool:
    """Whether a process has ended; one that nobody has asked after, now that its parent is dead, has."""
    try:
        return psutil.Process(process).status() == psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return True


def all_gone(processes: Iterable[int]) -> Callable[[], bool]:
    """Whether all of them have ended."""
    return lambda: all(map(is_gone, processes))
