"""Drawn spots fit: what is drawn from the regions is in the place, whatever the thing."""

from __future__ import annotations

from math import cos, sin

from hypothesis import given, settings
from hypothesis import strategies as st
from kitchen_world import KITCHEN

from llm3_bullet.tabletop.rectangles import Rectangle
from llm3_kitchen.domain import Kitchen
from llm3_kitchen.instance import FoodSpec, KitchenInstance
from llm3_kitchen.meals import PLACES
from llm3_kitchen.ranges import regions

share = st.floats(0.0, 1.0)


@settings(max_examples=10)
@given(st.integers(0, 10**6), st.tuples(share, share, share))
def test_whatever_is_drawn_stands_in_the_place(seed, shares):
    instance = Kitchen().instance("kitchen-6", seed)
    ranges = regions(instance)
    for thing in instance.things:
        for place in instance.places:
            bounds = (ranges["place", (thing.name, place.name), axis] for axis in ("x", "y", "theta"))
            x, y, theta = (low + part * (high - low) for part, (low, high) in zip(shares, bounds, strict=True))
            covered = Rectangle((round(x, 4), round(y, 4)), thing.size[:2], (cos(theta), sin(theta)))
            assert place.holds(covered)


def test_there_is_a_range_for_each_parameter_of_each_thing_in_each_place():
    assert len(regions(KITCHEN)) == len(KITCHEN.things) * len(KITCHEN.places) * 3


def test_what_fits_only_one_way_is_turned_and_what_does_not_fit_is_in_the_middle():
    ladle = FoodSpec("ladle", (0.28, 0.05, 0.05), (0.6, 0.0), 1.57)
    ranges = regions(KitchenInstance(PLACES, (ladle,)))
    assert ranges["place", ("ladle", "store"), "theta"] == (1.5708, 1.5708)
    assert ranges["place", ("ladle", "sink"), "y"] == (0.38, 0.38)
