"""Worker processes of this machine, one of which may die without harm to the others."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import Executor, Future
from types import TracebackType
from typing import Any, TypeVar

from llm3.errors import LLM3Error, UsageError
from llm3.experiments.worker_process import DiedBefore, WorkerDied, WorkerProcess

T = TypeVar("T")
Item = tuple["Future[Any]", Callable[..., Any], tuple[Any, ...]]


class SpawnedWorkers(Executor):
    """Processes that work for this one: the standard executor, but for what happens when a process dies.

    The standard library's pool cannot tell whose work killed a process, and fails everything. Here each process has a
    thread of this one, which hands it one piece of work after another. If it dies, that work alone fails, with a
    `WorkerDied`, and another process takes its place.

    Processes are spawned, never forked, and started when there is work for them. They pay no heed to Ctrl-C, which a
    terminal sends to all of them, and leave it to this process. They end when this process does, in whatever way it
    ends. What they print to stdout goes to stderr.

    What is submitted is a function of a module, and its arguments and its result can be pickled; texts are best. If it
    raises an exception, that is told as a `WorkFailed`. If a process ends before it can work at all, everything fails
    with an `LLM3Error`, since the next one would fare no better.

    Leaving the ``with`` waits for the work; leaving it by an exception, such as Ctrl-C, stops it.
    """

    def __init__(self, count: int) -> None:
        """Have so many workers.

        Raises:
            UsageError: It is less than one.
        """
        if count < 1:
            raise UsageError(f"the number of workers must be at least 1, not {count}.")
        self._items: deque[Item] = deque()
        self._change = threading.Condition()  # of all these
        self._closed = self._stopped = False
        self._workers: set[WorkerProcess] = set()
        self._fault: LLM3Error | None = None
        self._reaping = threading.Lock()
        self._threads = [threading.Thread(target=self._employ, daemon=True) for _ in range(count)]
        for thread in self._threads:
            thread.start()

    def submit(self, fn: Callable[..., T], /, *args: Any, **kwargs: Any) -> Future[T]:
        """Have a worker call the function.

        Raises:
            RuntimeError: The workers were shut down or stopped.
        """
        if kwargs:
            raise TypeError("a worker's function takes positional arguments only.")
        future: Future[T] = Future()
        with self._change:
            if self._closed:
                raise RuntimeError("the workers were shut down.")
            self._items.append((future, fn, args))
            self._change.notify()
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Take no more work, and end the workers when they have done what there is."""
        with self._change:
            self._closed = True
            left = list(self._items) if cancel_futures else []
            if cancel_futures:
                self._items.clear()
            self._change.notify_all()
        for future, _, _ in left:
            future.cancel()
        if wait:
            for thread in self._threads:
                thread.join()

    def stop(self) -> None:
        """End the workers now. Work that they do is lost and fails with a `WorkerDied`; the rest is cancelled."""
        with self._change:
            self._stopped = True
            for worker in self._workers:
                worker.kill()
        self.shutdown(cancel_futures=True)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self.shutdown()
        else:
            self.stop()

    def _next(self) -> Item | None:
        """Wait for work; None if there will be no more."""
        with self._change:
            self._change.wait_for(lambda: self._items or self._closed)
            return self._items.popleft() if self._items else None

    def _employ(self) -> None:
        """Hand work to one process after another until there is no more. What a thread does."""
        worker: WorkerProcess | None = None
        while (item := self._next()) is not None:
            future, function, arguments = item
            if not future.set_running_or_notify_cancel():
                continue
            try:
                while True:
                    worker = worker or self._start()
                    try:
                        future.set_result(worker.do(function, arguments))
                        break
                    except DiedBefore:  # it died without work, which is nobody's loss
                        self._end(worker)
                        worker = None
            except WorkerDied as error:
                self._end(worker)
                worker = None
                future.set_exception(WorkerDied("the workers were stopped.") if self._stopped else error)
            except Exception as error:
                future.set_exception(error)
            del item, future  # whoever has it may let go of it
        self._end(worker)

    def _start(self) -> WorkerProcess:
        """A process that is ready.

        Raises:
            LLM3Error: It, or one before it, could not be started.
            WorkerDied: The workers were stopped.
        """
        with self._change:
            if self._fault or self._stopped:
                raise self._fault or WorkerDied
            try:
                worker = WorkerProcess(self._reaping)
            except (OSError, RuntimeError) as error:
                raise self._broken(str(error).strip().partition("\n\n")[0]) from error
            self._workers.add(worker)
        try:
            worker.wait_until_ready()
        except WorkerDied as error:
            self._end(worker)
            with self._change:
                if self._stopped:
                    raise
                raise self._broken(str(error)) from error
        return worker

    def _broken(self, reason: str) -> LLM3Error:
        """What all work fails with from now on."""
        self._fault = self._fault or LLM3Error(
            f"a worker process did not start: {reason.rstrip('.')}. A script that starts workers must do so below "
            'if __name__ == "__main__".'
        )
        return self._fault

    def _end(self, worker: WorkerProcess | None) -> None:
        if worker:
            with self._change:
                self._workers.discard(worker)
            worker.end()
