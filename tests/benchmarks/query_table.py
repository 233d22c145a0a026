"""What the comparison of planners says, as Markdown."""

from __future__ import annotations

import platform
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.metadata import version
from itertools import pairwise
from os import cpu_count, environ

import numpy as np
from planners import BATCHED, BATCHED_RAW, OMPL, OMPL_RAW, OURS, OURS_RAW, PUBLISHED, Answer
from queries import Queries, Query

from llm3.types import MotionProblem, Path, Vector
from llm3_bullet.workcell import Workcell

ALLOWED_DEPTH = 0.001
"""Metres that count as no contact: the margin of PyBullet's convex hulls."""
FINER = 4
"""How much closer than the resolution a path is sampled when it is looked at again."""


@dataclass(frozen=True, eq=False)
class Sample:
    """One planner's answer to one query with one seed."""

    query: Query
    seconds: float
    answer: Answer
    touches: bool
    """Whether a finer look finds the path in contact with something."""

    @property
    def path(self) -> Path | None:
        """The path that was found."""
        return None if self.answer.waypoints is None else Path(self.answer.waypoints)


@dataclass
class Comparison:
    """All samples by planner, in the same order of queries and seeds for each."""

    queries: Queries
    cell: Workcell
    samples: dict[str, list[Sample]] = field(default_factory=dict)

    def add(self, name: str, seconds: Sequence[float], answers: Sequence[Answer]) -> None:
        """Take a planner's times and answers, in the order of the queries."""
        for query, time, answer in zip(self.queries.chosen, seconds, answers, strict=True):
            touches = answer.waypoints is not None and self._touches(query, answer.waypoints)
            self.samples.setdefault(name, []).append(Sample(query, time, answer, touches))

    def _touches(self, query: Query, waypoints: Vector) -> bool:
        finer = sampled(query.problem(self.cell), waypoints, FINER)
        return not self.cell.checker.view(query.scene).valid(finer, -ALLOWED_DEPTH).all()


def sampled(problem: MotionProblem, waypoints: Vector, finer: int) -> Vector:
    """Configurations along a path, so many times closer than the problem's resolution."""
    pieces = [waypoints[:1]]
    for start, end in pairwise(waypoints):
        steps = max(1, int(np.ceil(finer * (np.abs(end - start) / problem.resolution).sum())))
        pieces.append(start + (end - start) * (np.arange(1, steps + 1) / steps)[:, None])
    return np.vstack(pieces)


def markdown(comparison: Comparison) -> str:
    """The tables, and what they were measured on."""
    samples = comparison.samples
    return "\n".join(
        [
            *_table("all queries", samples),
            "",
            *_table("queries that need a tree", {name: _winding(own) for name, own in samples.items()}),
            "",
            *_ratios(samples),
            "",
            *_conditions(comparison),
        ]
    )


def _table(what: str, samples: Mapping[str, Sequence[Sample]]) -> Iterator[str]:
    yield f"| {what} | median ms | p90 ms | mean ms | success | touching | verdicts/s | length | turning |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for name, own in samples.items():
        times = 1000 * np.array([sample.seconds for sample in own])
        paths = [sample.path for sample in own if sample.path]
        touching, verdicts = sum(sample.touches for sample in own), sum(sample.answer.verdicts for sample in own)
        cells = [
            *(f"{value:.3g}" for value in (np.median(times), np.percentile(times, 90), times.mean())),
            f"{len(paths)}/{len(own)}",
            f"{touching}",
            f"{1000 * verdicts / times.sum():,.0f}",
            f"{np.mean([path.length for path in paths]):.2f}",
            f"{np.mean([path.turning for path in paths]):.2f}",
        ]
        yield f"| {name} | {' | '.join(cells)} |"


def _ratios(samples: Mapping[str, Sequence[Sample]]) -> Iterator[str]:
    """How many times longer the others take, and how much longer their paths are."""
    yield "| times of | to | median | mean | median, tree needed | mean, tree needed | length of paths |"
    yield "|---|---|---|---|---|---|---|"
    for theirs, ours in (
        (PUBLISHED, OURS),
        (OMPL_RAW, OURS_RAW),
        (OMPL, OURS),
        (BATCHED_RAW, OURS_RAW),
        (BATCHED, OURS),
    ):
        a, b = samples[theirs], samples[ours]
        measures: list[tuple[Callable[..., np.floating], Sequence[Sample], Sequence[Sample]]] = [
            (np.median, a, b),
            (np.mean, a, b),
            (np.median, _winding(a), _winding(b)),
            (np.mean, _winding(a), _winding(b)),
        ]
        ratios = [f"{measure(_seconds(x)) / measure(_seconds(y)):.1f}" for measure, x, y in measures]
        both = [(x.path.length, y.path.length) for x, y in zip(a, b, strict=True) if x.path and y.path]
        lengths = np.mean(both, axis=0)
        yield f"| {theirs} | {ours} | {' | '.join(ratios)} | {lengths[0] / lengths[1]:.2f} |"


def _conditions(comparison: Comparison) -> Iterator[str]:
    queries = comparison.queries
    seeds = len(next(iter(comparison.samples.values()))) // len(queries.chosen)
    met = ", ".join(f"{number} {stratum}" for stratum, number in sorted(queries.met.items()))
    packages = ", ".join(f"{name} {version(name)}" for name in ("numpy", "pybullet", "pybullet-planning", "ompl"))
    threads = "one thread" if environ.get("OPENBLAS_NUM_THREADS") == "1" else "as many threads as it takes"
    python = f"{platform.python_implementation()} {platform.python_version()}"
    yield f"{len(queries.chosen)} queries, {seeds} seeds each. Transits to choose from, by gripper and way: {met}."
    yield f"{cpu_count()} cores ({platform.machine()}), no GPU; {python}, {packages}; numpy on {threads}."


def _winding(samples: Sequence[Sample]) -> Sequence[Sample]:
    return [sample for sample in samples if sample.query.winding]


def _seconds(samples: Sequence[Sample]) -> list[float]:
    return [sample.seconds for sample in samples]
