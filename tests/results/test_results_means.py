"""Means and their bootstrap intervals."""

import warnings

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.results import Estimate, mean_estimate, mean_estimates

figures = st.integers(-1000, 1000).map(float) | st.floats(-1e6, 1e6)
samples = st.lists(figures, min_size=6, max_size=40)


@given(samples)
def test_the_mean_lies_in_the_interval_and_that_among_the_values(values):
    found = mean_estimate(values)
    low, high = found.interval
    slack = 1e-9 * max(map(abs, values))
    assert found.n == len(values)
    assert found.mean == pytest.approx(np.mean(values), abs=slack)
    assert min(values) - slack <= low <= high <= max(values) + slack


@given(samples, st.integers(-50, 50), st.sampled_from([-2.0, 0.5, 3.0]))
def test_another_unit_and_another_zero_change_nothing_else(values, shift, scale):
    low, high = mean_estimate(values).interval
    moved = mean_estimate([scale * value + shift for value in values]).interval
    slack = 1e-6 * max(1, *map(abs, values))
    assert moved == pytest.approx(sorted((scale * low + shift, scale * high + shift)), abs=slack)


@given(samples)
def test_the_same_values_have_the_same_interval(values):
    assert mean_estimate(values) == mean_estimate(list(values))


@given(st.lists(st.tuples(figures, figures, figures), min_size=1, max_size=20))
def test_columns_do_not_depend_on_one_another(rows):
    together = mean_estimates(np.array(rows))
    for column, found in zip(zip(*rows, strict=True), together, strict=True):
        alone = mean_estimate(column)
        assert (found.n, found.interval is None) == (alone.n, alone.interval is None)
        slack = 1e-9 * max(1, *map(abs, column))
        assert found.mean == pytest.approx(alone.mean, abs=slack)
        assert found.interval is None or found.interval == pytest.approx(alone.interval, abs=slack)


def test_fewer_than_six_values_have_none():
    for n in range(1, 6):
        assert mean_estimate([4.0] * n) == Estimate(n, 4.0, None)


def test_values_that_are_all_equal_have_one_without_width_and_no_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert mean_estimate([20.0] * 10) == Estimate(10, 20.0, (20.0, 20.0))


def test_few_values_have_a_wider_interval_than_the_plain_percentile_bootstrap():
    values = np.array([1.0, 2.0, 2.0, 3.0, 5.0, 8.0, 20.0, 20.0, 4.0, 1.0])
    rng = np.random.default_rng(1)
    plain = np.quantile(values[rng.integers(10, size=(20_000, 10))].mean(axis=1), (0.025, 0.975))
    low, high = mean_estimate(values).interval
    assert 1.1 < (high - low) / (plain[1] - plain[0]) < 1.35


def test_many_values_have_about_the_interval_of_the_normal_distribution():
    values = np.random.default_rng(2).geometric(0.2, 3000).clip(max=20)
    half = 1.96 * values.std(ddof=1) / np.sqrt(len(values))
    assert mean_estimate(values).interval == pytest.approx((values.mean() - half, values.mean() + half), abs=half / 8)


@pytest.mark.slow
@pytest.mark.parametrize(("n", "least"), [(10, 0.90), (50, 0.925)])
def test_about_95_of_100_intervals_hold_the_truth_of_capped_counts(n, least):
    rng = np.random.default_rng(3)
    truth = sum(0.9**k for k in range(20))
    drawn = np.minimum(rng.geometric(0.1, (n, 3000)), 20).astype(float)
    hits = [found.interval[0] <= truth <= found.interval[1] for found in mean_estimates(drawn)]
    assert least < np.mean(hits) < 0.975
