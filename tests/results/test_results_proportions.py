"""Shares of runs and their paired differences: laws, published values, and how often the intervals are right."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.results import paired_share_difference, share_estimate

counts = st.integers(1, 500).flatmap(lambda n: st.tuples(st.integers(0, n), st.just(n)))
tables = st.lists(st.integers(0, 60), min_size=4, max_size=4).filter(any)


@given(counts)
def test_a_share_lies_in_its_interval_and_that_in_0_to_1(count):
    k, n = count
    found = share_estimate(k, n)
    low, high = found.interval
    assert (found.n, found.mean) == (n, k / n)
    assert 0 <= low <= found.mean <= high <= 1
    assert low < high


@given(counts)
def test_failures_have_the_mirrored_interval(count):
    k, n = count
    low, high = share_estimate(k, n).interval
    assert share_estimate(n - k, n).interval == pytest.approx((1 - high, 1 - low), abs=1e-12)


@given(counts)
def test_more_runs_make_it_narrower(count):
    k, n = count
    widths = [high - low for low, high in (share_estimate(k * m, n * m).interval for m in (1, 4))]
    assert widths[1] < widths[0]


@pytest.mark.parametrize(
    ("k", "n", "interval"),
    [
        # Newcombe (1998), Statistics in Medicine 17, 857-872, Table I, method 3
        (81, 263, (0.2553, 0.3662)),
        (15, 148, (0.0624, 0.1605)),
        (0, 20, (0.0, 0.1611)),
        (1, 29, (0.0061, 0.1718)),
        (6, 10, (0.3127, 0.8318)),  # the 31 to 83 % of a success rate of 60 % in ten attempts
    ],
)
def test_published_intervals_of_a_share(k, n, interval):
    assert share_estimate(k, n).interval == pytest.approx(interval, abs=5e-5)


@given(tables)
def test_the_difference_is_antisymmetric(table):
    first, second, _, _ = table
    n = sum(table)
    one, other = paired_share_difference(first, second, n), paired_share_difference(second, first, n)
    assert one.n == other.n == n
    assert one.mean == -other.mean
    assert one.interval == pytest.approx((-other.interval[1], -other.interval[0]), abs=1e-12)


@given(tables)
def test_the_difference_is_that_of_the_two_shares_and_its_interval_can_be(table):
    first, second, both, _ = table
    n = sum(table)
    found = paired_share_difference(first, second, n)
    assert found.mean == pytest.approx((first + both) / n - (second + both) / n)
    low, high = found.interval
    assert -1 <= low < high <= 1
    assert low - 1e-9 <= found.mean <= high + 1e-9


@pytest.mark.parametrize(
    ("first", "second", "n", "interval"),
    [
        # the example of Bonett's R package statpsych, ci.prop.ps(.05, 12, 4, 26, 6)
        (26, 4, 48, (0.2548067, 0.6251933)),
        # Bentur et al. (2009), the example of Fagerland, Lydersen and Laake (2014), Statistics in Medicine 33, 2850
        (1, 7, 21, (-0.508, -0.013)),
    ],
)
def test_published_intervals_of_a_paired_difference(first, second, n, interval):
    assert paired_share_difference(first, second, n).interval == pytest.approx(interval, abs=6e-4)


@pytest.mark.slow
@pytest.mark.parametrize("chance", [0.1, 0.6, 0.95])
@pytest.mark.parametrize("n", [10, 50])
def test_about_95_of_100_intervals_of_a_share_hold_the_truth(n, chance):
    rng = np.random.default_rng(5)
    intervals = {k: share_estimate(k, n).interval for k in range(n + 1)}
    hits = [intervals[k][0] <= chance <= intervals[k][1] for k in rng.binomial(n, chance, 20_000).tolist()]
    assert 0.91 < np.mean(hits) < 0.99


@pytest.mark.slow
@pytest.mark.parametrize("chances", [(0.2, 0.2, 0.4, 0.2), (0.3, 0.05, 0.6, 0.05), (0.05, 0.05, 0.5, 0.4)])
@pytest.mark.parametrize("n", [10, 50])
def test_at_least_about_95_of_100_intervals_of_a_difference_hold_the_truth(n, chances):
    rng = np.random.default_rng(6)
    truth = chances[0] - chances[1]
    drawn = rng.multinomial(n, chances, 5_000).tolist()
    intervals = (paired_share_difference(first, second, n).interval for first, second, _, _ in drawn)
    assert np.mean([low <= truth <= high for low, high in intervals]) > 0.935
