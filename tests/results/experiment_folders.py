"""Writes experiment folders with known results."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from llm3.experiments import (
    Budgets,
    Column,
    Experiment,
    Group,
    Layout,
    Method,
    ProblemFamily,
    Published,
    RunKey,
    RunLine,
)
from llm3.experiments.folder import (
    EXPERIMENT_FILE,
    EXPERIMENT_FORMAT,
    RUNS_FILE,
    RUNS_FORMAT,
    ExperimentFile,
)
from llm3.jsonio import dumps, pretty
from llm3.types import Stats

PAPER = "LLM3 (arXiv:2403.11552)"
SIZES = ("easy-small", "medium-small", "hard-small", "hard-medium", "hard-large")


def experiment(
    methods: Iterable[str] = ("one", "other"),
    problems: Iterable[str] = ("hard-small",),
    seeds: int = 10,
    layouts: tuple[Layout, ...] = (),
    published: tuple[Published, ...] = (),
    title: str = "An experiment",
) -> Experiment:
    return Experiment(
        "made-up",
        title,
        tuple(range(seeds)),
        tuple(ProblemFamily(name, "boxpack", name) for name in problems),
        tuple(Method(name, name.partition(" (")[0], {}) for name in methods),
        layouts,
        published,
    )


def run(
    method: str = "one", problem: str = "hard-small", seed: int = 0, calls: int = 3, status: str = "solved", **fields
) -> RunLine:
    """A run whose other figures follow from its model calls."""
    motions, reused = fields.pop("motions", 7 * calls), fields.pop("reused", calls)
    stats = Stats(
        llm_calls=0 if status == "crashed" else calls,
        motion_calls=motions,
        reused_actions=reused,
        prompt_tokens=1000 * calls,
        completion_tokens=100 * calls,
    )
    usual = {"stop": "solved" if status == "solved" else "", "iterations": calls, "model": "gpt", "seconds": calls / 2}
    usual["language_model"] = bool(fields.get("model", "gpt"))
    return RunLine(RunKey(method, problem, seed), status, stats=stats, **{**usual, **fields})  # type: ignore[arg-type]  # a test's own


def write(folder: Path, made: Experiment, runs: Iterable[RunLine], versions: dict[str, str] | None = None) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    file = ExperimentFile(EXPERIMENT_FORMAT, made, versions or {"llm3": "0.1.0"})
    (folder / EXPERIMENT_FILE).write_text(pretty(file), encoding="utf-8")
    lines = [dumps({"format": RUNS_FORMAT}), *map(dumps, runs)]
    (folder / RUNS_FILE).write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    return folder


def capped(method: str, problem: str, calls: Iterable[int], cap: int = 20) -> list[RunLine]:
    """One run a seed; those that reach the cap are not solved."""
    return [
        run(
            method,
            problem,
            seed,
            min(number, cap),
            "solved" if number < cap else "not solved",
            stop="solved" if number < cap else "calls",
            failures={} if number < 3 else {"goal in collision": number // 2, "unreachable": number - number // 2 - 2},
        )
        for seed, number in enumerate(calls)
    ]


TABLE1 = Layout(
    "Table I",
    ("success", "llm_calls", "motion_calls"),
    (
        Group(
            "Setting 1", (Column("Easy", "easy-small"), Column("Medium", "medium-small"), Column("Hard", "hard-small"))
        ),
        Group(
            "Setting 2", (Column("Small", "hard-small"), Column("Medium", "hard-medium"), Column("Large", "hard-large"))
        ),
    ),
)
TABLE1_PAPER = Published(
    PAPER,
    TABLE1.measures,
    {
        "LLM3 Backtrack": {
            "easy-small": (100, 1.6, 11.8),
            "medium-small": (100, 4.4, 28.4),
            "hard-small": (60, 11.4, 39.8),
            "hard-medium": (80, 9.5, 50),
            "hard-large": (50, 13.5, 44.8),
        },
        "Backtrack": {
            "easy-small": (100, 1.8, 12.6),
            "medium-small": (90, 6.3, 32),
            "hard-small": (40, 15.1, 55.3),
            "hard-medium": (30, 14.6, 16),
            "hard-large": (30, 15.8, 48),
        },
        "LLM3 Scratch": {
            "easy-small": (100, 1.7, 13.2),
            "medium-small": (100, 7, 46.1),
            "hard-small": (70, 8.8, 30.9),
            "hard-medium": (70, 11.5, 50.2),
            "hard-large": (60, 10.6, 32),
        },
        "Scratch": {
            "easy-small": (100, 2.4, 17.6),
            "medium-small": (60, 12.3, 45.3),
            "hard-small": (50, 13.7, 42.8),
            "hard-medium": (30, 16.2, 45.7),
            "hard-large": (40, 13.2, 24),
        },
    },
    "the paper",
)
TABLE2 = Layout("Table II", ("iterations", "motion_calls"), (Group("", (Column("Medium", "medium-small"),)),))
TABLE2_PAPER = Published(
    PAPER,
    TABLE2.measures,
    {
        "Random Samples": {"medium-small": (109.6, 663.1)},
        "LLM": {"medium-small": (10.8, 70.2)},
        "LLM + Feedback": {"medium-small": (7.9, 53.2)},
    },
    "the paper",
)


def table1(folder: Path) -> Path:
    """Four methods on five problems with ten seeds: one run crashed, one had no answer, and two are missing."""
    made = experiment(TABLE1_PAPER.figures, SIZES, 10, (TABLE1,), (TABLE1_PAPER,), "Four methods that pack a basket")
    runs = [
        line
        for m, method in enumerate(TABLE1_PAPER.figures)
        for p, problem in enumerate(SIZES)
        for line in capped(
            method, problem, ((3 * seed * (p + m) + seed + p + 1) % (4 + 6 * p) + 1 for seed in range(10))
        )
    ]
    lost = {("Scratch", "hard-large", 8), ("Scratch", "hard-large", 9)}
    runs = [r for r in runs if (r.key.method, r.key.problem, r.key.seed) not in lost]
    runs[3] = run("LLM3 Backtrack", "easy-small", 3, 0, "crashed", error="KeyError: 'red\nbox'", traceback="Traceback")
    runs[60] = run("Backtrack", "easy-small", 10 - 10, 2, "error", error="the server does not answer.")
    return write(folder, made, runs)


def table2(folder: Path) -> Path:
    """Samplers of parameters, two of them without a language model; the last one has not begun."""
    made = experiment(TABLE2_PAPER.figures, ("medium-small",), 7, (TABLE2,), (TABLE2_PAPER,), "Samplers")
    random = [
        run("Random Samples", "medium-small", s, n, motions=6 * n, model="", time_limited=s == 3)
        for s, n in enumerate((90, 150, 88, 201, 3, 77, 140))
    ]
    return write(folder, made, [*random, *capped("LLM", "medium-small", (4, 20, 1, 9, 12, 2, 6))])


def budgets(folder: Path) -> Path:
    """A model, rules that stand in for one and a search on two problems, and budgets that they are asked about."""
    made = experiment(("model", "rules", "search"), ("hard-small", "hard-large"), 7, title="Three ways to pack")
    asked = Budgets(llm_calls=(1, 5, 20), motion_calls=(10, 50, 200), tokens=(2000, 20_000))
    calls = {"hard-small": (1, 4, 2, 20, 5, 1, 3), "hard-large": (20, 9, 20, 20, 2, 6, 12)}
    runs = [line for problem, counts in calls.items() for line in capped("model", problem, counts)]
    runs[5] = run("model", "hard-small", 5, 2, "error", error="the server does not answer.")
    for problem, counts in calls.items():
        runs += [_alone(line, line.stats.llm_calls) for line in capped("rules", problem, counts[::-1])]
        runs += [_alone(line, 0) for line in capped("search", problem, (3 * count for count in counts), 50)]
    return write(folder, replace(made, budgets=asked), runs)


def _alone(line: RunLine, calls: int) -> RunLine:
    """The same without a model."""
    stats = Stats(llm_calls=calls, motion_calls=line.stats.motion_calls)
    return replace(line, model="", language_model=False, stats=stats)
