"""Which job is next, with no more runs at once than each provider of models can take."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping

from llm3.assembly import RunConfig
from llm3.experiments.experiment import Job


def provider(config: RunConfig) -> str:
    """Whom a run asks: what stands before the slash of a model's name, else the backend; empty for nobody."""
    if config.is_search:
        return ""
    before, slash, _ = (config.model or "").partition("/")
    return before if slash else config.backend.partition(":")[0]


class Schedule:
    """Hands out jobs in order, but for those whose provider is busy.

    A run makes one model call at a time, so runs at once bound the calls at once. That is counted where the jobs are
    handed out, and so holds over processes and machines.
    """

    def __init__(self, jobs: Iterable[Job], limits: Mapping[str, int]) -> None:
        """Take the jobs.

        Args:
            jobs: In the order in which they are wanted.
            limits: How many runs at once a provider takes; none for those that are not there.
        """
        self._limits = limits
        self._waiting: dict[str, deque[tuple[int, Job]]] = {}
        self._running: dict[str, int] = {}
        for number, job in enumerate(jobs):
            self._waiting.setdefault(provider(job.config), deque()).append((number, job))

    def __len__(self) -> int:
        """How many jobs wait."""
        return sum(map(len, self._waiting.values()))

    def next(self) -> Job | None:
        """The first job whose provider is not busy, which counts as running from now on; None if there is none."""
        ready = [name for name, jobs in self._waiting.items() if jobs and self._room(name)]
        if not ready:
            return None
        name = min(ready, key=lambda name: self._waiting[name][0][0])
        self._running[name] = self._running.get(name, 0) + 1
        return self._waiting[name].popleft()[1]

    def ended(self, job: Job) -> None:
        """A job that was handed out has ended."""
        self._running[provider(job.config)] -= 1

    def _room(self, name: str) -> bool:
        return self._running.get(name, 0) < self._limits.get(name, float("inf"))
