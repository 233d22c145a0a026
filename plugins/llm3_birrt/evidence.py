"""What is told of a search that failed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np

from llm3.types import Contact, Failure, FailureKind, MotionProblem, Stats
from llm3_birrt.connect import Gap, Stop

MAX_EXPLAINED = 64
"""Blocked configurations that are looked at more closely."""
MIN_SHARE = 0.1
"""An object is to blame if it was touched in at least this share of them."""


def no_path(problem: MotionProblem, gap: Gap, stops: Sequence[Stop], stats: Stats) -> Failure:
    """Where the attempts to join the trees were stopped, and by what.

    Objects come in the order of how often they were touched; contacts and configuration are those of the stop that
    was nearest to the other tree, among those that touched the first object.

    Args:
        problem: The query.
        gap: What the search left.
        stops: Where it was stopped, at least one.
        stats: What it cost.
    """
    looked_at = np.linspace(0, len(stops) - 1, min(MAX_EXPLAINED, len(stops))).astype(int)
    found = [problem.explain(stops[i].blocked) for i in looked_at]
    hits = Counter(name for contacts in found for name in dict.fromkeys(contact.object for contact in contacts))
    to_blame = [(name, count / len(found)) for name, count in hits.most_common() if count >= MIN_SHARE * len(found)]
    measures = {
        "iterations": stats.planner_iterations,
        "start_tree": gap.start_tree,
        "goal_tree": gap.goal_tree,
        "gap": gap.distance,
        "stops": len(stops),
    }
    if to_blame:
        measures["hit_share"] = to_blame[0][1]
    telling = [i for i, contacts in zip(looked_at, found, strict=True) if _touches(contacts, to_blame)]
    nearest = min((stops[i] for i in telling), key=lambda stop: stop.gap)
    return Failure(
        FailureKind.NO_PATH,
        objects=tuple(name for name, _ in to_blame),
        contacts=tuple(sorted(problem.explain(nearest.blocked), key=lambda contact: -contact.depth)),
        configuration=tuple(nearest.blocked.tolist()),
        measures=measures,
        stats=stats,
    )


def _touches(contacts: Sequence[Contact], to_blame: Sequence[tuple[str, float]]) -> bool:
    """Whether what is to blame most is touched; true where nothing is to blame."""
    return not to_blame or any(contact.object == to_blame[0][0] for contact in contacts)
