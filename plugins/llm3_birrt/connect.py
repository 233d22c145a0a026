"""RRT-Connect: two trees that grow towards each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from llm3.types import Vector
from llm3_birrt.budget import Budget
from llm3_birrt.free_space import FreeSpace
from llm3_birrt.tree import Tree

STEP = 0.12
"""Length of an extension as a fraction of the diagonal of the joint limits: about 1.5 rad for a 7-joint arm."""
PATIENCE = 250
"""Iterations after which the first pair of trees is given up; each further pair is given twice as many."""


@dataclass(frozen=True, eq=False)
class Bridge:
    """The trees met."""

    waypoints: Vector
    """From the start to the goal, shape (N, dof); its edges are free."""
    root: int
    """Which of the goals it ends at."""


@dataclass(frozen=True)
class Gap:
    """The trees did not meet."""

    distance: float
    """The smallest joint-space distance at which an attempt to join the trees was stopped."""
    start_tree: int
    """Nodes of the tree that grew from the start."""
    goal_tree: int
    """Nodes of the tree that grew from the goals."""


def rrt_connect(
    space: FreeSpace, start: Vector, goals: Vector, budget: Budget, rng: np.random.Generator
) -> Bridge | Gap:
    """Join the start to one of the goals, with new trees each time the old ones had their chance.

    The iterations that a search needs have a heavy tail: unlucky trees stay unlucky, and to plant new ones is
    quicker than to wait. As their lifetime doubles, a solution that needs large trees is found as well.

    Args:
        space: The free space.
        start: A free configuration, shape (dof,).
        goals: Free configurations, shape (G, dof).
        budget: Iterations and time.
        rng: The only source of randomness.

    Returns:
        The bridge; or, when the budget ends, the gap of the trees that came nearest to each other.

    Source: J. J. Kuffner and S. M. LaValle, "RRT-Connect: An efficient approach to single-query path planning",
    ICRA 2000; several goals are several roots of one tree. Restarts: N. A. Wedge and M. S. Branicky, "On heavy-tailed
    runtimes and restarts in rapidly-exploring random trees", AAAI 2008.
    """
    patience, gaps = PATIENCE, []
    while True:
        result = _grow_trees(space, start, goals, budget, rng, patience)
        if isinstance(result, Bridge):
            return result
        gaps.append(result)
        if budget.is_spent:
            return min(gaps, key=lambda gap: gap.distance)
        patience *= 2


def _grow_trees(
    space: FreeSpace, start: Vector, goals: Vector, budget: Budget, rng: np.random.Generator, patience: int
) -> Bridge | Gap:
    """Grow a tree from the start and one from all goals, in turn, until they meet.

    An iteration extends one tree by a step towards a random configuration, then the other one step by step towards
    the new node for as long as it is free.
    """
    step = STEP * float(np.linalg.norm(space.high - space.low))
    start_tree, goal_tree = Tree(start[None]), Tree(goals)
    grown, other = start_tree, goal_tree
    gap = float(np.linalg.norm(goals - start, axis=1).min())
    for _ in range(patience):
        if not budget.spend():
            break
        new = _extend(space, grown, space.sample(rng), step)
        if new is not None:
            target = grown[new]
            met = _approach(space, other, target, step)
            gap = min(gap, float(np.linalg.norm(other[met] - target)))
            if np.array_equal(other[met], target):
                from_start, from_goal = (new, met) if grown is start_tree else (met, new)
                return _join(start_tree, from_start, goal_tree, from_goal)
        grown, other = other, grown
    return Gap(gap, len(start_tree), len(goal_tree))


def _extend(space: FreeSpace, tree: Tree, target: Vector, step: float, base: int | None = None) -> int | None:
    """Add a node one step from `base` (the nearest node by default) towards `target`, where that is free."""
    base = tree.nearest(target) if base is None else base
    configuration = space.step(tree[base], target, step)
    return tree.add(configuration, base) if space.edge(tree[base], configuration) else None


def _approach(space: FreeSpace, tree: Tree, target: Vector, step: float) -> int:
    """Extend the tree towards `target` as far as it is free, and answer the node that came nearest."""
    last = tree.nearest(target)
    while not np.array_equal(tree[last], target):
        new = _extend(space, tree, target, step, last)
        if new is None:
            break
        last = new
    return last


def _join(start_tree: Tree, from_start: int, goal_tree: Tree, from_goal: int) -> Bridge:
    """The path through two nodes at the same configuration."""
    there = start_tree.branch(from_start)[::-1]
    onward = goal_tree.branch(from_goal)
    waypoints = np.vstack([start_tree.configurations(there), goal_tree.configurations(onward[1:])])
    return Bridge(waypoints, root=onward[-1])
