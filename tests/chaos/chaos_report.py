"""What became of many episodes."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from llm3 import RunConfig
from llm3.testing import REPLY_FAULTS, WIRE_FAULTS
from llm3.types import Result

KINDS = (*REPLY_FAULTS, *WIRE_FAULTS)
COUNTED = ("llm_calls", "retries", "step_downs")
"""What the records tell of requests."""


@dataclass(frozen=True)
class Episode:
    """How one run ended, by its own record, and what the server answered meanwhile."""

    domain: str
    config: RunConfig
    answers: tuple[str, ...]
    """What the server says that it answered to each request."""
    record: dict
    """run.json."""
    events: tuple[dict, ...]
    """The lines of events.jsonl."""
    result: Result | None
    """None if it ended in a BackendError."""

    @property
    def end(self) -> str:
        """Why it ended, in a few words."""
        return self.record["stop"] or f"error: {self.record['error'][:150]}"

    @property
    def requests(self) -> int:
        """All requests that the record tells of."""
        return sum(self.record["stats"][name] for name in COUNTED)


@dataclass(frozen=True)
class Report:
    """What became of all episodes."""

    episodes: tuple[Episode, ...]
    served: int
    """Requests that the server counted."""
    left: tuple[str, ...] = field(default=())
    """Threads and sockets that were there at the end and not at the beginning."""

    @property
    def injected(self) -> Counter[str]:
        return Counter(answer for episode in self.episodes for answer in episode.answers if answer in KINDS)

    @property
    def share(self) -> float:
        """How many of the answers that were no refusals carried a fault."""
        answers = [answer for episode in self.episodes for answer in episode.answers]
        return sum(self.injected.values()) / len([a for a in answers if not a.startswith("refused")])

    @property
    def ends(self) -> Counter[str]:
        return Counter(f"{episode.domain}: {episode.end}" for episode in self.episodes)

    def __str__(self) -> str:
        total = Counter()
        for episode in self.episodes:
            total.update({k: episode.record["stats"][k] for k in COUNTED})
        lines = [f"{len(self.episodes)} episodes; {self.served} requests, of which with a fault:"]
        lines += [f"  {self.injected[kind]:5}  {kind}" for kind in KINDS]
        lines += [f"  {sum(self.injected.values()):5}  altogether, {self.share:.1%} of what was not refused"]
        lines += ["how they ended:"]
        lines += [f"  {count:5}  {end}" for end, count in sorted(self.ends.items())]
        counted = " + ".join(f"{total[k]} {k}" for k in COUNTED)
        lines += [f"the server counted {self.served}; the records {sum(total.values())} = {counted}"]
        lines += [f"left behind: {', '.join(self.left) or 'nothing'}"]
        return "\n".join(lines)
