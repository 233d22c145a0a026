"""How many runs are solved within a budget: the tables, and the curves of the figures, which are the same shares."""

import csv
import io
import json
from dataclasses import fields, replace
from itertools import pairwise

import pytest
from experiment_folders import budgets, experiment, run, write
from hypothesis import given
from hypothesis import strategies as st

from llm3.experiments import Budgets, ExperimentRecord, read_experiment_folder
from llm3.results import Estimate, report, share_estimate, summarize
from llm3.results.measures import VALUES, is_attempt
from llm3.results.table import Table
from llm3.results.within import UNITS, curve, shares_within
from llm3.types import FrozenDict, Stats

METHODS, PROBLEMS, SEEDS = ("one", "other"), ("hard-small", "easy-small"), 7
STATUSES = ("solved", "not solved", "error", "crashed")
AMPLE = 10**9

some_runs = st.lists(
    st.builds(
        run,
        st.sampled_from(METHODS),
        st.sampled_from(PROBLEMS),
        st.integers(0, SEEDS - 1),
        st.integers(0, 20),
        st.sampled_from(STATUSES),
    ),
    max_size=28,
    unique_by=lambda r: r.key,
)
amounts = st.lists(st.integers(1, 25_000), max_size=6, unique=True).map(lambda found: (*sorted(found), AMPLE))
some_budgets = st.builds(Budgets, **{field.name: amounts for field in fields(Budgets)})


def cells(runs, asked, problems=PROBLEMS, seconds=True):
    made = replace(experiment(METHODS, problems, SEEDS), budgets=asked)
    record = ExperimentRecord("somewhere", made, FrozenDict(), FrozenDict({r.key: r for r in runs}))
    return {(c.method, c.problem): c for c in summarize([record], seconds)[0].cells}


def test_there_is_a_word_for_each_kind_of_budget():
    assert list(UNITS) == [field.name for field in fields(Budgets)]


# ---- shares --------------------------------------------------------------------------------------------------------


@given(some_runs, some_budgets)
def test_a_run_counts_as_solved_from_what_it_spent_on_and_an_unsolved_one_never(runs, asked):
    for cell in cells(runs, asked).values():
        attempts = list(filter(is_attempt, cell.ended))
        for (measure, budget), share in cell.within.items():
            solved = sum(r.solved and VALUES[measure](r) <= budget for r in attempts)
            assert share == share_estimate(solved, len(attempts))


@given(some_runs, some_budgets)
def test_a_larger_budget_solves_no_fewer_and_an_ample_one_all_that_is_solved(runs, asked):
    for cell in cells(runs, asked).values():
        for measure, growing in asked.by_measure.items():
            shares = [cell.within[measure, budget] for budget in growing if (measure, budget) in cell.within]
            for less, more in pairwise(shares):
                assert less.mean <= more.mean
                assert all(a <= b for a, b in zip(less.interval, more.interval, strict=True))
            if shares:
                assert shares[-1] == cell.estimates["success", "all"]


@given(some_runs, some_budgets)
def test_errors_and_crashes_change_no_share(runs, asked):
    whole, attempts = (cells(ours, asked) for ours in (runs, filter(is_attempt, runs)))
    assert {place: c.within for place, c in whole.items()} == {place: c.within for place, c in attempts.items()}


@given(some_runs, some_budgets)
def test_all_problems_together_have_the_runs_of_each(runs, asked):
    found = cells(runs, asked)
    for method in METHODS:
        pooled = found[method, None]
        for place, share in pooled.within.items():
            parts = [p.within[place] for p in (found[method, name] for name in PROBLEMS) if place in p.within]
            assert sum(p.n for p in parts) == share.n
            assert sum(p.n * p.mean for p in parts) == pytest.approx(share.n * share.mean)


@given(some_runs, some_budgets, st.sampled_from(tuple(UNITS)))
def test_the_table_is_the_curve(runs, asked, measure):
    for cell in cells(runs, asked).values():
        attempts = list(filter(is_attempt, cell.ended))
        if not attempts:
            continue
        x, shares = curve(attempts, measure, max(map(VALUES[measure], attempts)))
        assert list(x) == sorted(set(x))
        for (kind, budget), share in cell.within.items():
            if kind == measure:
                assert share == [at for where, at in zip(x, shares, strict=True) if where <= budget][-1]


@given(some_runs.filter(bool), st.lists(st.integers(0, 25_000)))
def test_budgets_can_be_asked_for_in_any_order(runs, asked):
    assert shares_within(runs, "tokens", asked) == tuple(shares_within(runs, "tokens", [one])[0] for one in asked)


# ---- what a budget means nothing to --------------------------------------------------------------------------------

ONE_OF_EACH = Budgets((20,), (500,), (50_000,), (60,))


def known(runs):
    return {measure for measure, _ in cells(runs, ONE_OF_EACH)["one", "hard-small"].within}


def searched(seed=0, status="solved"):
    return replace(run(seed=seed, status=status, model=""), stats=Stats(motion_calls=9))


def answered_without_tokens(seed=0, status="solved"):
    return replace(run(seed=seed, status=status), stats=Stats(llm_calls=3, motion_calls=9))


@pytest.mark.parametrize("status", ["solved", "not solved"])
def test_a_search_has_no_share_within_model_calls_and_tokens(status):
    assert known([searched(seed, status) for seed in range(3)]) == {"motion_calls", "seconds"}


@pytest.mark.parametrize("status", ["solved", "not solved"])
def test_what_stands_in_for_a_model_has_none_within_tokens(status):
    assert known([answered_without_tokens(seed, status) for seed in range(3)]) == set(UNITS) - {"tokens"}


def test_where_some_answers_have_no_tokens_none_is_told_as_cheap():
    assert known([run(), answered_without_tokens(1)]) == set(UNITS) - {"tokens"}


def test_a_run_that_needs_no_answer_is_solved_within_every_budget():
    at_the_goal = replace(run(seed=1), stats=Stats())
    found = cells([run(calls=19), at_the_goal], Budgets(llm_calls=(1, 19), tokens=(1,)))["one", "hard-small"].within
    assert {place: share.mean for place, share in found.items()} == {
        ("llm_calls", 1): 0.5,
        ("llm_calls", 19): 1.0,
        ("tokens", 1): 0.5,
    }


def test_a_model_that_never_answered_solved_nothing():
    late = [replace(run(seed=seed, status="not solved", stop="seconds"), stats=Stats(retries=1)) for seed in range(3)]
    found = cells(late, ONE_OF_EACH)["one", "hard-small"].within
    assert {found[place] for place in found} == {share_estimate(0, 3)}
    assert known(late) == set(UNITS)


def test_a_model_that_moved_nothing_solved_nothing():
    unreadable = [run(seed=seed, status="not solved", motions=0, reused=0) for seed in range(3)]
    assert cells(unreadable, ONE_OF_EACH)["one", "hard-small"].within["motion_calls", 500] == share_estimate(0, 3)


def test_without_runs_there_is_no_share():
    assert known([run("other")]) == set()


def test_what_depends_on_the_machine_can_be_left_out():
    found = cells([run()], ONE_OF_EACH, seconds=False)["one", "hard-small"].within
    assert {measure for measure, _ in found} == set(UNITS) - {"seconds"}


# ---- tables --------------------------------------------------------------------------------------------------------


def folder_of(where, asked, runs):
    return write(where, replace(experiment(METHODS, PROBLEMS, SEEDS), budgets=asked), runs)


def test_there_is_a_table_for_each_kind_that_is_named(tmp_path):
    runs = [run(m, p, s, 1 + s) for m in METHODS for p in PROBLEMS for s in range(SEEDS)]
    for asked, titles in (
        (Budgets(), []),
        (Budgets(tokens=(5000,)), ["tokens"]),
        (Budgets((1, 5), (), (2000,), (1,)), ["model calls", "tokens", "seconds"]),
    ):
        summary = summarize([read_experiment_folder(folder_of(tmp_path, asked, runs))])
        (section,) = report(summary)
        found = [item for item in section.content if not isinstance(item, str) and item.title.startswith("Solved")]
        assert [table.title for table in found] == [f"Solved within a budget of {unit}" for unit in titles]
        assert [bool(table.notes) for table in found] == [False] * len(found[1:]) + [True] * bool(found)
        for table in found:
            assert [row[:2] for row in table.rows] == [(m, p) for m in METHODS for p in (*PROBLEMS, "all problems")]


@pytest.mark.parametrize("format_", ["text", "markdown", "csv"])
def test_equal_runs_give_equal_bytes_whatever_the_machine_took(command, cwd, format_):
    runs = [run(m, p, s, 1 + s) for m in METHODS for p in PROBLEMS for s in range(SEEDS)]
    here = folder_of(cwd / "here", ONE_OF_EACH, runs)
    there = folder_of(cwd / "there", ONE_OF_EACH, [replace(r, seconds=r.seconds**2) for r in reversed(runs)])
    one, two = (command("results", str(folder), "--format", format_, "--no-seconds") for folder in (here, there))
    assert one == two
    assert "seconds" not in one.out
    assert "50000" in one.out


def test_csv_has_each_share_with_its_interval(command, cwd):
    folder = budgets(cwd / "done")
    rows = csv.DictReader(io.StringIO(command("results", str(folder), "--format", "csv").out))
    within = [row for row in rows if row["kind"] == "within"]
    (summary,) = summarize([read_experiment_folder(folder)])
    expected = {
        (c.method, c.problem or "", measure, str(budget)): share
        for c in summary.cells
        for (measure, budget), share in c.within.items()
    }
    assert {(r["method"], r["problem"], r["measure"], r["budget"]) for r in within} == set(expected)
    for row in within:
        share = expected[row["method"], row["problem"], row["measure"], row["budget"]]
        assert Estimate(int(row["n"]), float(row["mean"]), (float(row["low"]), float(row["high"]))) == Estimate(
            share.n, pytest.approx(share.mean, rel=1e-5), pytest.approx(share.interval, rel=1e-5)
        )
        assert row["over"] == "all"
    assert {r["measure"] for r in within if r["method"] == "search"} == {"motion_calls"}
    assert {r["measure"] for r in within if r["method"] == "rules"} == {"llm_calls", "motion_calls"}


def test_a_folder_that_names_no_budgets_can_be_read(tmp_path):
    folder = folder_of(tmp_path, Budgets(), [run()])
    path = folder / "experiment.json"
    written = json.loads(path.read_text(encoding="utf-8"))
    del written["experiment"]["budgets"]
    path.write_text(json.dumps(written), encoding="utf-8")
    assert read_experiment_folder(folder).experiment.budgets == Budgets()


def test_a_budget_of_which_no_method_spends_anything_has_no_table(tmp_path):
    """Stand-ins read and write no tokens."""
    made = replace(experiment(("one",), ("hard-small",), 2), budgets=Budgets(llm_calls=(1, 5), tokens=(1000,)))
    quiet = [replace(run("one", "hard-small", seed), language_model=False) for seed in (0, 1)]
    runs = [replace(line, stats=replace(line.stats, prompt_tokens=0, completion_tokens=0)) for line in quiet]
    record = read_experiment_folder(write(tmp_path / "done", made, runs))
    titles = [
        part.title for section in report(summarize([record])) for part in section.content if isinstance(part, Table)
    ]
    assert "Solved within a budget of model calls" in titles
    assert "Solved within a budget of tokens" not in titles
