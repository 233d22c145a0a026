"""Names in a drawing can be read."""

from __future__ import annotations

from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from llm3.report.labels import LINE, WIDTH, labels

SIZE, LEFT, RIGHT = 10.0, 0.0, 400.0
names = st.text("abcdefgh_", min_size=1, max_size=12)
things = st.lists(st.tuples(names, st.floats(LEFT, RIGHT), st.floats(0, 300)), max_size=7)


def told(things):
    return list(labels(things, SIZE, LEFT, RIGHT))


@given(things)
def test_every_thing_has_its_name_near_it(things):
    found = told(things)
    assert [label.name for label in found] == [name for name, _, _ in things]
    for label, (_, _, y) in zip(found, things, strict=True):
        assert abs(label.y - y) <= 3 * LINE * SIZE + 1e-6


@given(things)
def test_no_name_crosses_the_sides(things):
    for label in told(things):
        half = len(label.name) * WIDTH * SIZE / 2
        assert label.x - half >= LEFT - 1e-6
        assert label.x + half <= RIGHT + 1e-6


@given(st.lists(names, min_size=1, max_size=7), st.floats(100, 300))
def test_names_of_things_in_one_place_stand_in_lines_of_their_own(names, x):
    rows = sorted(label.y for label in told([(name, x, 150.0) for name in names]))
    assert all(after - before >= LINE * SIZE * 0.99 for before, after in pairwise(rows))


def test_a_name_that_nothing_covers_stands_on_its_thing():
    (first, second) = told([("one", 50.0, 50.0), ("two", 350.0, 50.0)])
    assert (first.x, first.y, second.x, second.y) == (50.0, 50.0, 350.0, 50.0)
