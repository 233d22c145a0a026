"""Cells and paired differences: what is counted, what is left out, and what adds up."""

from dataclasses import replace

import pytest
from experiment_folders import experiment, run, write
from hypothesis import assume, given
from hypothesis import strategies as st

from llm3.experiments import ExperimentRecord, ProblemFamily, read_experiment_folder
from llm3.results import Estimate, mean_estimate, paired_share_difference, share_estimate, sign_flip_test, summarize
from llm3.types import FrozenDict, Stats

METHODS, PROBLEMS, SEEDS = ("one", "other"), ("hard-small", "easy-small"), 7
STATUSES = ("solved", "not solved", "error", "crashed")


def record(runs, methods=METHODS, problems=PROBLEMS, seeds=SEEDS, folder="somewhere") -> ExperimentRecord:
    made = experiment(methods, problems, seeds)
    return ExperimentRecord(folder, made, FrozenDict(), FrozenDict({r.key: r for r in runs}))


def cell(summary, method, problem):
    (found,) = [c for c in summary.cells if (c.method, c.problem) == (method, problem)]
    return found


def difference(summary, problem, since=False):
    (found,) = [d for d in (summary.since if since else summary.differences) if d.problem == problem]
    return found


some_runs = st.lists(
    st.builds(
        run,
        st.sampled_from(METHODS),
        st.sampled_from(PROBLEMS),
        st.integers(0, SEEDS - 1),
        st.integers(1, 20),
        st.sampled_from(STATUSES),
    ),
    max_size=28,
    unique_by=lambda r: r.key,
)


def test_the_figures_of_a_cell():
    runs = [run(seed=s, calls=c, status="solved" if c < 20 else "not solved") for s, c in enumerate((2, 20, 5, 20))]
    (summary,) = summarize([record(runs, problems=PROBLEMS[:1])])
    found = cell(summary, "one", "hard-small")
    assert (found.attempts, found.wanted, found.missing) == (4, 7, 3)
    assert found.estimates["success", "all"] == share_estimate(2, 4)
    assert found.estimates["llm_calls", "all"] == mean_estimate([2, 20, 5, 20])
    assert found.estimates["llm_calls", "solved"] == mean_estimate([2, 5])
    assert found.estimates["motion_calls", "solved"].mean == 7 * 3.5
    assert found.estimates["motion_calls_with_reused", "solved"].mean == 8 * 3.5
    assert found.estimates["tokens", "solved"].mean == 1100 * 3.5
    assert found.estimates["seconds", "all"].mean == 47 / 8
    assert not cell(summary, "other", "hard-small").estimates


def test_tokens_that_a_server_does_not_count_are_not_known_and_no_zero():
    uncounted = replace(run(seed=1, calls=4, status="not solved"), stats=Stats(llm_calls=4, motion_calls=9))
    (summary,) = summarize([record([run(calls=3), uncounted], problems=PROBLEMS[:1])])
    found = cell(summary, "one", "hard-small").estimates
    assert ("tokens", "all") not in found
    assert found["tokens", "solved"].mean == 1100 * 3
    stood_in = replace(uncounted, language_model=False)
    (summary,) = summarize([record([stood_in], problems=PROBLEMS[:1])])
    assert cell(summary, "one", "hard-small").estimates["tokens", "all"].mean == 0.0


def test_a_search_makes_no_model_calls_but_has_iterations():
    searched = [replace(run(seed=s, calls=0, model="", motions=9), iterations=12) for s in range(2)]
    (summary,) = summarize([record(searched)])
    found = cell(summary, "one", "hard-small").estimates
    assert (found["llm_calls", "all"].mean, found["iterations", "all"].mean) == (0, 12)


@given(some_runs)
def test_every_run_is_an_attempt_or_an_error_or_missing(runs):
    (summary,) = summarize([record(runs)])
    assert len(summary.cells) == len(METHODS) * (len(PROBLEMS) + 1)
    for found in summary.cells:
        assert found.attempts + found.count("error") + found.count("crashed") + found.missing == found.wanted
        assert ("success", "all") in found.estimates or not found.attempts
        for (_, over), estimate in found.estimates.items():
            assert estimate.n == (found.attempts if over == "all" else found.count("solved"))


@given(some_runs)
def test_errors_and_crashes_change_no_figure(runs):
    kept = [r for r in runs if r.status in ("solved", "not solved")]
    (with_errors,), (without,) = summarize([record(runs)]), summarize([record(kept)])
    assert [c.estimates for c in with_errors.cells] == [c.estimates for c in without.cells]
    assert with_errors.differences == without.differences


@given(some_runs)
def test_the_pooled_cell_has_the_runs_of_all_problems(runs):
    (summary,) = summarize([record(runs)])
    for method in METHODS:
        pooled, parts = cell(summary, method, None), [cell(summary, method, p) for p in PROBLEMS]
        assert pooled.attempts == sum(p.attempts for p in parts)
        assert pooled.wanted == sum(p.wanted for p in parts)
        assert pooled.count("solved") == sum(p.count("solved") for p in parts)
    assert difference(summary, None).pairs == sum(difference(summary, p).pairs for p in PROBLEMS)


@given(some_runs)
def test_differences_are_antisymmetric(runs):
    assume({r.key.method for r in runs if r.status in ("solved", "not solved")} == {"one", "other"})
    one, other = (summarize([record(runs, methods)])[0] for methods in (METHODS, METHODS[::-1]))
    for problem in (*PROBLEMS, None):
        there, back = difference(one, problem), difference(other, problem)
        assert (there.method, there.against) == (back.against, back.method)
        assert there.pairs == back.pairs
        for measure, found in there.comparisons.items():
            mirrored = back.comparisons[measure]
            assert found.p == mirrored.p
            assert found.estimate.mean == pytest.approx(-mirrored.estimate.mean)
            if found.estimate.interval:
                low, high = mirrored.estimate.interval
                assert found.estimate.interval == pytest.approx((-high, -low))


def test_only_seeds_that_both_have_are_compared():
    runs = [run("one", seed=s, calls=3) for s in (0, 1, 2, 3)]
    runs += [run("other", seed=s, calls=c) for s, c in ((1, 5), (2, 3), (4, 1))]
    runs += [run("other", seed=3, calls=9, status="error"), run("other", seed=0, calls=20, status="not solved")]
    found = difference(summarize([record(runs)])[0], "hard-small")
    assert (found.method, found.against, found.pairs) == ("other", "one", 3)
    assert found.comparisons["success"].estimate == paired_share_difference(0, 1, 3)
    assert found.comparisons["llm_calls"].estimate == mean_estimate([17, 2, 0])
    assert found.comparisons["llm_calls"].p == sign_flip_test([17, 2, 0])
    assert found.comparisons["motion_calls"].estimate.mean == pytest.approx(7 * 19 / 3)


def test_few_pairs_have_no_interval_of_means():
    runs = [run("one", calls=3), run("other", calls=5)]
    found = difference(summarize([record(runs)])[0], "hard-small").comparisons
    assert found["llm_calls"].estimate == Estimate(1, 2.0, None)
    assert found["llm_calls"].p == 1.0


def test_a_later_experiment_is_compared_with_the_first():
    first = record([run("one", seed=s, calls=3) for s in range(5)])
    later = record([run("one", seed=s, calls=3 + s) for s in range(5)])
    one, two = summarize([first, later])
    assert not one.since
    found = [d for d in two.since if d.method == "one" and d.problem == "hard-small"]
    assert [(d.against, d.comparisons["llm_calls"].estimate.mean) for d in found] == [("one", 2.0)]


def test_methods_that_differ_in_their_model_alone_are_compared():
    first = record([run("one (gpt)", calls=3)], ("one (gpt)", "two (gpt)"))
    later = record([run("one (qwen)", calls=8)], ("two (qwen)", "one (qwen)"))
    compared = {(d.method, d.against) for d in summarize([first, later])[1].since}
    assert compared == {("one (qwen)", "one (gpt)"), ("two (qwen)", "two (gpt)")}
    many = record([], ("one (a)", "one (b)"))
    assert not summarize([first, many])[1].since


def test_problems_that_are_not_the_same_are_not_compared():
    first = record([run(calls=3)], problems=PROBLEMS[:1])
    other = replace(first.experiment, problems=(ProblemFamily("hard-small", "boxpack", "hard-large"),))
    assert not summarize([first, replace(first, experiment=other)])[1].since


def test_times_change_nothing_but_times(tmp_path):
    made = experiment(METHODS, PROBLEMS, SEEDS)
    runs = [run(m, p, s, 1 + s) for m in METHODS for p in PROBLEMS for s in range(SEEDS)]
    slower = [replace(r, seconds=r.seconds * 3 + r.key.seed**2) for r in runs]
    one, two = (
        summarize([read_experiment_folder(write(tmp_path / name, made, lines))], seconds=False)[0]
        for name, lines in (("one", runs), ("two", slower))
    )
    assert [c.estimates for c in one.cells] == [c.estimates for c in two.cells]
    assert one.differences == two.differences
