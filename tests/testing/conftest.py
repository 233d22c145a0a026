import threading
from pathlib import Path

import pytest


def open_files() -> int:
    return len(list(Path("/dev/fd").iterdir()))


@pytest.fixture(autouse=True)
def nothing_is_left(monkeypatch):
    """No thread and no open file survives a test; the surroundings' proxies stay out of it."""
    monkeypatch.setenv("NO_PROXY", "127.0.0.1")
    threads, files = set(threading.enumerate()), open_files()
    yield
    assert set(threading.enumerate()) <= threads
    assert open_files() <= files
