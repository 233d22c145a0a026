"""The exact test of paired differences."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import binomtest

from llm3.results import sign_flip_test

differences = st.lists(st.integers(-30, 30), max_size=10)


def by_enumeration(values):
    sums = [sum(sign * v for sign, v in zip(signs, values, strict=True)) for signs in signs_of(len(values))]
    return sum(abs(s) >= abs(sum(values)) for s in sums) / len(sums)


def signs_of(n):
    return list(itertools.product((-1, 1), repeat=n))


@given(differences)
def test_it_is_the_share_of_all_choices_of_signs(values):
    assert sign_flip_test(values) == pytest.approx(by_enumeration(values))


@given(differences, st.randoms())
def test_order_signs_of_all_and_pairs_without_a_difference_do_not_matter(values, random):
    p = sign_flip_test(values)
    shuffled = [*values, 0, 0]
    random.shuffle(shuffled)
    assert sign_flip_test(shuffled) == p
    assert sign_flip_test([-v for v in values]) == p
    assert 0 <= p <= 1


@given(st.integers(0, 300), st.integers(0, 300))
def test_of_successes_it_is_mcnemars_exact_test(gained, lost):
    p = sign_flip_test([1] * gained + [-1] * lost)
    assert p == pytest.approx(binomtest(gained, gained + lost).pvalue if gained + lost else 1.0, abs=1e-12)


def test_published_values():
    # Bentur et al. (2009) in Fagerland, Lydersen and Laake (2013), BMC Medical Research Methodology 13, 91
    assert sign_flip_test([1] + [-1] * 7) == pytest.approx(0.0703, abs=5e-5)
    # Darwin's maize in Fisher (1935), The Design of Experiments, section 21: 863 of 32,768 on one side
    darwin = [49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48]
    assert sign_flip_test(darwin) == pytest.approx(2 * 863 / 32768, abs=1e-12)


def test_without_a_difference_nothing_is_unlikely():
    assert sign_flip_test([]) == sign_flip_test([0, 0, 0]) == sign_flip_test([5, -5]) == 1.0


def test_where_there_are_too_many_sums_choices_are_drawn_and_p_is_never_0():
    rng = np.random.default_rng(0)
    spread = rng.integers(-100_000, 100_000, 1000)
    p = sign_flip_test(spread)
    assert p == sign_flip_test(spread[::-1]) == sign_flip_test(-spread)
    exact = sign_flip_test(spread // 100)
    assert p == pytest.approx(exact, abs=0.03)
    assert sign_flip_test(np.abs(spread)) == 1 / 10_001


@pytest.mark.slow
def test_under_the_hypothesis_p_is_small_as_seldom_as_it_says():
    rng = np.random.default_rng(4)
    found = np.array([sign_flip_test(row) for row in rng.integers(-10, 11, (2000, 12))])
    for level in (0.01, 0.05, 0.2):
        assert np.mean(found <= level) < level + 3 * np.sqrt(level * (1 - level) / len(found))
