"""What the tests have worker processes do."""

from __future__ import annotations

import multiprocessing
import os
import re
import signal
import sys
import time
from pathlib import Path


def echo(text: str) -> str:
    return text


def process(_text: str) -> str:
    return str(os.getpid())


def how_started(_text: str) -> str:
    return multiprocessing.get_start_method(allow_none=True) or type(multiprocessing.current_process()).__name__


def refuse(text: str) -> str:
    raise ValueError(text)


def leave(text: str) -> str:
    sys.exit(text)


def end(code: str) -> str:
    os._exit(int(code))


def die(name: str) -> str:
    os.kill(os.getpid(), signal.Signals[name])
    return "still alive"


def say(text: str) -> str:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()
    os.write(1, f"{text} from native code\n".encode())
    return text


def unspeakable(_text: str) -> object:
    return lambda: None


def sleep(marker: str) -> str:
    """Say who is there, and sleep."""
    Path(marker).write_text(str(os.getpid()), encoding="utf-8")
    time.sleep(600)
    return marker


def compute(marker: str) -> str:
    """Say who is there, and be busy in native code that lets no thread of Python run, for years."""
    Path(marker).write_text(str(os.getpid()), encoding="utf-8")
    re.match(r"(a|a)*b", "a" * 60)
    return marker


def wait_for(marker: str) -> str:
    """Say who is there, and wait until somebody takes the marker away."""
    Path(marker).write_text(str(os.getpid()), encoding="utf-8")
    while Path(marker).exists():
        time.sleep(0.01)
    return marker
