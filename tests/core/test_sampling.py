"""Where parameters are drawn from without a model."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.errors import PluginError
from llm3.interfaces import drawn, sampling_ranges
from llm3.types import ActionSchema, Parameter, Sketch

GO = ActionSchema("go", ("robot",), (Parameter("x", 0, 2, "m"), Parameter("y", -1, 1, "m")), "walk")
SKETCH = Sketch("go", ("ann",))


@given(st.floats(0, 2), st.floats(0, 2), st.integers(0, 99))
def test_what_is_drawn_lies_in_the_region_and_else_in_the_schemas_range(one, other, seed):
    low, high = sorted((one, other))
    ranges = sampling_ranges(GO, ("ann",), {("go", ("ann",), "x"): (low, high), ("go", ("bob",), "y"): (5, 6)})
    assert ranges == {"x": (low, high), "y": (-1, 1)}
    action = drawn(SKETCH, ranges, np.random.default_rng(seed))
    assert low <= action.params["x"] <= high
    assert -1 <= action.params["y"] <= 1
    assert action == drawn(SKETCH, ranges, np.random.default_rng(seed))


def test_a_region_is_cut_off_where_the_schema_ends():
    assert sampling_ranges(GO, ("ann",), {("go", ("ann",), "x"): (-3, 1)})["x"] == (0, 1)


@pytest.mark.parametrize("region", [(1, 0.5), (3, 4), (float("nan"), 1), (0, float("inf"))])
def test_what_is_no_range_within_the_schemas_is_the_domains_mistake(region):
    with pytest.raises(PluginError) as caught:
        sampling_ranges(GO, ("ann",), {("go", ("ann",), "x"): region})
    assert str(caught.value) == (
        f"the region of 'x' for go(['ann'], ...) must be a range within 0 to 2, not {region[0]:g} to {region[1]:g}."
    )
