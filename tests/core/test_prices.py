"""A bill is what the user's own prices say of the tokens that the server counted."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.errors import InputError
from llm3.prices import Price, read_prices
from llm3.types import Stats

prices = st.floats(0.0, 1000.0)
counts = st.integers(0, 10**7)
spendings = st.builds(Stats, prompt_tokens=counts, cached_tokens=counts, completion_tokens=counts)


@given(st.builds(Price, prices, prices, st.none() | prices), spendings, spendings)
def test_two_calls_cost_what_each_of_them_costs(price, first, second):
    first, second = (replace(s, cached_tokens=min(s.cached_tokens, s.prompt_tokens)) for s in (first, second))
    assert price.of(first + second) == pytest.approx(price.of(first) + price.of(second))


@given(st.builds(Price, prices, prices), spendings)
def test_without_a_price_of_its_own_a_cached_token_costs_what_any_other_does(price, stats):
    assert price.of(stats) == pytest.approx(
        (stats.prompt_tokens * price.read + stats.completion_tokens * price.written) / 1e6
    )


def test_a_bill():
    spent = Stats(prompt_tokens=3_000_000, cached_tokens=1_000_000, completion_tokens=500_000, reasoning_tokens=400_000)
    assert Price(read=2.0, written=8.0, cached=0.5).of(spent) == 2 * 2.0 + 0.5 + 4.0


def test_a_table_is_a_file(tmp_path):
    path = tmp_path / "prices.json"
    path.write_text(
        json.dumps({"lab/small": {"read": 2, "written": 8}, "lab/large": {"read": 20, "written": 80, "cached": 5}})
    )
    assert read_prices(path) == {"lab/small": Price(2.0, 8.0), "lab/large": Price(20.0, 80.0, 5.0)}


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ('{"m": {"read": 1}}', "Object missing required field `written` - at `$[...]`"),
        ('{"m": {"read": -1, "written": 1}}', "read must be a price of 0 or more, not -1 - at `$[...]`"),
        ("[]", "Expected `object`, got `array`"),
    ],
)
def test_a_table_that_makes_no_sense_is_refused(tmp_path, text, sentence):
    path = tmp_path / "prices.json"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        read_prices(path)
    assert str(caught.value) == f"{path}: {sentence}"
