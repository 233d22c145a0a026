"""One worker process: this side of it, and that side."""

from __future__ import annotations

import contextlib
import ctypes
import multiprocessing
import os
import signal
import sys
import threading
import traceback
from collections.abc import Callable
from multiprocessing import resource_tracker
from multiprocessing.connection import Connection, wait
from multiprocessing.reduction import ForkingPickler
from typing import Any

PATIENCE = 5.0
"""Seconds that a process without work may take to end; it is killed after them."""
PR_SET_PDEATHSIG = 1
"""Linux's number for: send me this signal when the thread that started me ends."""


class WorkerDied(Exception):
    """A worker process ended in the middle of its work; the text says how."""


class DiedBefore(WorkerDied):
    """A worker process ended before it took the work that it was given."""


class WorkFailed(Exception):
    """What a worker was given raised an exception; the text is the traceback, as the worker saw it."""


class WorkerProcess:
    """A process that does what it is told, one thing after another."""

    def __init__(self, reaping: threading.Lock) -> None:
        """Start it.

        Args:
            reaping: Is held while processes are started and their endings read, by all threads that do so: each start
                looks for processes that ended, and what one thread has read of an ending is lost for the others.

        Raises:
            OSError: The system has no room for it.
            RuntimeError: This is itself a worker that is being started, as of a script without a main guard.
        """
        context = multiprocessing.get_context("spawn")
        self._connection, other = context.Pipe()
        self._process = context.Process(target=_serve, args=(other,), daemon=True)
        self._reaping = reaping
        try:
            with reaping:
                _start(self._process)
        except BaseException:
            self._connection.close()
            raise
        finally:
            other.close()

    def wait_until_ready(self) -> None:
        """Wait until it can work.

        Raises:
            WorkerDied: It ended before.
        """
        self._receive()

    def do(self, function: Callable[..., Any], arguments: tuple[Any, ...]) -> Any:
        """Have it call a function, and wait for the answer.

        Raises:
            DiedBefore: It had ended before, so nothing of this was done.
            WorkerDied: It ended before it answered.
            WorkFailed: The function raised an exception.
        """
        try:
            self._connection.send((function, arguments))
            self._receive()
        except OSError:
            raise DiedBefore(self._ending()) from None
        except WorkerDied as error:
            raise DiedBefore(str(error)) from None
        done, answer = self._receive()
        if not done:
            raise WorkFailed(answer)
        return answer

    def kill(self) -> None:
        """End it now; whoever waits for an answer is told that it died."""
        with self._reaping:
            self._process.kill()

    def end(self) -> None:
        """Let it end, unless it has, and leave nothing behind."""
        self._connection.close()
        self._exit_code()
        self._process.close()

    def _receive(self) -> Any:
        try:
            return self._connection.recv()
        except (EOFError, OSError):
            raise WorkerDied(self._ending()) from None

    def _ending(self) -> str:
        code = self._exit_code()
        if code >= 0:
            return f"the worker process ended with exit code {code}."
        names = {int(known): known.name for known in signal.Signals}
        name = names.get(-code, f"signal {-code}")
        remark = ", as the system does when memory runs out" if name == "SIGKILL" else ""
        return f"the worker process was ended by {name}{remark}."

    def _exit_code(self) -> int:
        wait([self._process.sentinel], PATIENCE)
        with self._reaping:
            self._process.kill()  # does nothing to a process that is ending already
            self._process.join()
            code = self._process.exitcode
        assert code is not None  # noqa: S101  # it was waited for
        return code


def _start(process: Any) -> None:
    """Start a process that does not get Ctrl-C, not even before it can say so itself."""
    if sys.platform == "win32":
        process.start()
        return
    resource_tracker.ensure_running()  # the first process would start it, and it resets the mask
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        process.start()  # inherits the mask
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _serve(connection: Connection) -> None:
    """What the process does: take work and answer, until there is no more."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a terminal sends it to all processes; the first one decides
    os.dup2(2, 1)  # stdout is for results, and native code writes there too
    sys.stdout = sys.stderr
    _end_with_parent()
    with contextlib.suppress(EOFError, OSError):  # nobody is there any more
        connection.send("ready")
        while True:
            message = connection.recv_bytes()
            connection.send("taken")
            connection.send_bytes(_answer(message))


def _answer(message: bytes) -> bytes:
    """Do what a message asks, and make the message that answers it.

    The messages are those of `Connection.send`; what cannot be read or answered is an answer, too.
    """
    try:
        function, arguments = ForkingPickler.loads(message)
        return bytes(ForkingPickler.dumps((True, function(*arguments))))
    except BaseException:  # also of a plugin that calls sys.exit: the process lives on
        return bytes(ForkingPickler.dumps((False, traceback.format_exc())))


def _end_with_parent() -> None:
    """See to it that this process ends when the one that started it does, in whatever way, and whatever it does."""
    threading.Thread(target=_watch_parent, daemon=True).start()
    if sys.platform == "linux":  # the thread does not get to run while native code holds the interpreter's lock
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def _watch_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None  # noqa: S101  # this is a spawned process
    wait([parent.sentinel])
    os._exit(1)
