"""The parts of the planner: edges, trees and shortcuts."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from llm3.interfaces.free_space import bisection_order
from llm3.types import Goal, Mask, MotionProblem, Vector
from llm3_birrt.joint_space import FIRST_BATCH, JointSpace
from llm3_birrt.shorten import MIN_GAIN, shorten
from llm3_birrt.tree import Tree

QUICK = settings(deadline=None, max_examples=60)
values = st.floats(0.0, 1.0)
points = st.tuples(values, values).map(np.array)


def space_of(valid, resolution: float = 0.05) -> JointSpace:
    return JointSpace(MotionProblem(np.zeros(2), (Goal((1.0, 1.0)),), 0.0, 1.0, valid, resolution))


def everywhere(samples: Vector) -> Mask:
    return np.ones(len(samples), dtype=bool)


@given(st.integers(1, 3000))
@QUICK
def test_bisection_visits_every_sample_once(steps: int) -> None:
    assert sorted(bisection_order(steps)) == list(range(1, steps))


@given(st.integers(2, 3000), st.integers(1, 3000))
@QUICK
def test_every_beginning_of_a_bisection_is_spread_over_the_edge(steps: int, visited: int) -> None:
    seen = sorted({0, steps, *bisection_order(steps)[:visited].tolist()})
    assert max(np.diff(seen)) <= 4 * steps / min(visited, steps)


@given(points, points, st.floats(0.001, 0.5))
@QUICK
def test_neighbouring_samples_of_a_line_are_within_the_resolution(start, end, resolution) -> None:
    samples = np.vstack([start, *samples_of(start, end, resolution)])
    along = samples[np.argsort(samples @ (end - start))]
    assert any(np.array_equal(end, sample) for sample in samples)
    assert np.abs(np.diff(along, axis=0)).sum(axis=1).max() <= resolution * (1 + 1e-6) + 1e-9


@given(points, points)
@QUICK
def test_a_line_has_the_same_samples_in_both_directions(start, end) -> None:
    there, back = samples_of(start, end), samples_of(end, start)
    assert {sample.tobytes() for sample in [start, *there]} == {sample.tobytes() for sample in [end, *back]}


@given(points, points, st.floats(0.001, 0.5), st.floats(0.0, 1.0))
@QUICK
def test_the_samples_of_a_part_of_a_line_are_the_lines_own(start, end, resolution, where) -> None:
    whole = np.vstack([start, *samples_of(start, end, resolution)])
    cut = whole[int(where * (len(whole) - 1))]
    for part in (samples_of(start, cut, resolution), samples_of(cut, end, resolution)):
        distances = np.abs(part[:, None] - whole).max(axis=2)
        assert distances.min(axis=1).max() < 1e-12


def test_a_blocked_line_is_left_after_the_batch_that_shows_it() -> None:
    space = space_of(lambda samples: samples[:, 0] < 0.4, resolution=1e-4)
    blocked = space.obstacle(np.zeros(2), np.array([0.9, 0.0]))
    assert blocked is not None
    assert blocked[0] >= 0.4
    assert space.checks == FIRST_BATCH


@given(points, points, st.floats(0.001, 0.5), points, st.floats(0.0, 0.5))
@QUICK
def test_a_line_is_free_where_all_of_its_samples_are(start, end, resolution, centre, radius) -> None:
    valid = outside(centre, radius)
    all_free = valid(samples_of(start, end, resolution)).all()
    assert (space_of(valid, resolution).obstacle(start, end) is None) == all_free


@given(points, points, st.floats(0.001, 0.5), points, st.floats(0.0, 0.5), st.floats(0.01, 2.0))
@QUICK
def test_an_advance_goes_by_strides_as_far_as_it_is_free(start, end, resolution, centre, radius, length) -> None:
    valid = outside(centre, radius)
    samples = samples_of(start, end, resolution)
    samples = samples[np.argsort(samples @ (end - start), kind="stable")]
    blocked = np.flatnonzero(~valid(samples))
    line = space_of(valid, resolution).advance(start, end, length)
    nodes = np.vstack([start, line.nodes])
    assert np.linalg.norm(np.diff(nodes, axis=0), axis=1).max(initial=0.0) <= length + 2 * resolution
    if len(blocked):
        assert np.allclose(line.blocked, samples[blocked[0]], atol=1e-9)
        assert valid(line.nodes).all()
        assert np.linalg.norm(line.blocked - nodes[-1]) <= length + 2 * resolution
    else:
        assert line.blocked is None
        assert np.array_equal(line.nodes[-1], end)


@given(points, points, st.floats(0.01, 2.0))
@QUICK
def test_a_step_is_never_longer_than_asked(start, target, length) -> None:
    there = space_of(everywhere).step(start, target, length)
    assert np.linalg.norm(there - start) <= length + 1e-12
    assert np.linalg.norm(target - there) <= np.linalg.norm(target - start) + 1e-12
    if np.linalg.norm(target - start) <= length:
        assert there is target


@given(st.lists(points, min_size=1, max_size=3), st.lists(points, max_size=40), points)
@QUICK
def test_the_nearest_node_is_nearest(roots, others, query) -> None:
    tree = Tree(np.array(roots))
    for configuration in others:
        tree.add(configuration, parent=0)
    assert len(tree) == len(roots) + len(others)
    distances = np.linalg.norm(np.array([*roots, *others]) - query, axis=1)
    assert np.isclose(np.linalg.norm(tree[tree.nearest(query)] - query), distances.min())


@given(st.integers(1, 4), st.lists(st.integers(0, 10**6), max_size=30))
@QUICK
def test_a_branch_leads_to_its_root(roots: int, draws: list[int]) -> None:
    tree, root_of = Tree(np.zeros((roots, 2))), list(range(roots))
    for draw in draws:
        parent = draw % len(tree)
        root_of.append(root_of[parent])
        assert tree.add(np.zeros(2), parent) == len(root_of) - 1
    for node, root in enumerate(root_of):
        branch = tree.branch(node)
        assert (branch[0], branch[-1]) == (node, root)
        assert tree.configurations(branch).shape == (len(branch), 2)


@given(st.lists(points, min_size=2, max_size=8).map(np.array), st.integers(0, 99), points, st.floats(0.0, 0.3))
@QUICK
def test_smoothing_keeps_the_ends_and_never_lengthens(path, seed, centre, radius) -> None:
    shorter = shorten(path, space_of(outside(centre, radius)), np.random.default_rng(seed))
    assert np.array_equal(shorter[[0, -1]], path[[0, -1]])
    assert length(shorter) <= length(path) + 1e-9


@given(st.lists(points, min_size=2, max_size=8).map(np.array), st.integers(0, 99))
@QUICK
def test_where_all_is_free_smoothing_leaves_about_the_straight_line(path, seed) -> None:
    shorter = shorten(path, space_of(everywhere), np.random.default_rng(seed))
    assert length(shorter) <= length(path[[0, -1]]) / (1 - MIN_GAIN) + 1e-9


@given(st.lists(points, min_size=3, max_size=8).map(np.array), st.integers(0, 99), points, st.floats(0.0, 0.3))
@QUICK
def test_smoothing_a_free_path_leaves_a_free_path(path, seed, centre, radius) -> None:
    space = space_of(outside(centre, radius))
    assume(space.free(path).all() and is_free(path, space))
    assert is_free(shorten(path, space, np.random.default_rng(seed)), space)


def test_without_time_left_a_path_stays_as_it_is() -> None:
    path, space = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]), space_of(everywhere)
    assert np.array_equal(shorten(path, space, np.random.default_rng(0), in_time=lambda: False), path)
    assert space.checks == 0


def outside(centre: Vector, radius: float) -> Callable[[Vector], Mask]:
    return lambda samples: np.linalg.norm(samples - centre, axis=1) >= radius


def samples_of(start: Vector, end: Vector, resolution: float = 0.05) -> Vector:
    """The samples of a line, in the order in which they are tested."""
    batches = []

    def valid(samples: Vector) -> Mask:
        batches.append(samples)
        return everywhere(samples)

    assert space_of(valid, resolution).obstacle(start, end) is None
    return np.vstack(batches)


def is_free(path: Vector, space: JointSpace) -> bool:
    return all(space.obstacle(a, b) is None for a, b in pairwise(path))


def length(path: Vector) -> float:
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())
