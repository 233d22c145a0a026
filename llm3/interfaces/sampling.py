"""Where parameters are drawn from when no model chooses them."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite

import numpy as np

from llm3.errors import PluginError
from llm3.interfaces.backend import Regions
from llm3.types import Action, ActionSchema, Sketch

DECIMALS = 4
"""Parameters are drawn to 0.1 mm and 1e-4 rad, the grid of states."""

Ranges = Mapping[str, tuple[float, float]]
"""The lower and the upper end of each parameter, in the schema's order."""


def sampling_ranges(schema: ActionSchema, objects: tuple[str, ...], regions: Regions) -> Ranges:
    """Where the parameters of an action are drawn from: a region where the domain names one, else the schema's range.

    Args:
        schema: The action.
        objects: What it is done to.
        regions: The domain's; they may reach out of the schema's ranges, and are cut off there.

    Raises:
        PluginError: A region is no range, or lies outside of the schema's.
    """
    ranges: dict[str, tuple[float, float]] = {}
    for parameter in schema.parameters:
        region = regions.get((schema.name, objects, parameter.name), (parameter.low, parameter.high))
        low, high = max(region[0], parameter.low), min(region[1], parameter.high)
        if not all(map(isfinite, region)) or low > high:
            raise PluginError(
                f"the region of {parameter.name!r} for {Sketch(schema.name, objects)} must be a range within "
                f"{parameter.low:g} to {parameter.high:g}, not {region[0]:g} to {region[1]:g}."
            )
        ranges[parameter.name] = (low, high)
    return ranges


def drawn(sketch: Sketch, ranges: Ranges, rng: np.random.Generator) -> Action:
    """The action with parameters drawn uniformly from their ranges."""
    params: dict[str, float] = {}
    for name, (low, high) in ranges.items():
        value = round(float(rng.uniform(low, high)), DECIMALS)
        params[name] = min(max(value, low), high)  # rounding may step over a bound
    return Action(sketch.name, sketch.objects, params)
