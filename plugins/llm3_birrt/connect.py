"""RRT-Connect: two trees that grow towards each other."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from llm3.types import Vector
from llm3_birrt.budget import Budget
from llm3_birrt.joint_space import JointSpace
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


@dataclass(frozen=True, eq=False)
class Stop:
    """An attempt to join the trees that was stopped."""

    blocked: Vector
    """The configuration, shape (dof,), that was not free."""
    gap: float
    """How far it was still to go, in joint space."""


@dataclass(frozen=True, eq=False)
class Gap:
    """The trees did not meet."""

    distance: float
    """The smallest joint-space distance at which an attempt to join the trees was stopped."""
    start_tree: int
    """Nodes of the tree that grew from the start."""
    goal_tree: int
    """Nodes of the tree that grew from the goals."""
    stops: tuple[Stop, ...] = ()
    """The attempts to join the trees, in order."""


def rrt_connect(
    space: JointSpace, start: Vector, goals: Vector, budget: Budget, rng: np.random.Generator
) -> Bridge | Gap:
    """Join the start to one of the goals, with new trees each time the old ones had their chance.

    The iterations that a search needs have a heavy tail: unlucky trees stay unlucky, and to plant new ones is
    quicker than to wait. As their lifetime doubles, a solution that needs large trees is found as well.

    Args:
        space: The joint space.
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
        result = _Trees(space, start, goals).grow(budget, rng, patience)
        if isinstance(result, Bridge):
            return result
        gaps.append(result)
        if budget.is_spent:
            return min(gaps, key=lambda gap: gap.distance)
        patience *= 2


@dataclass(eq=False)
class _Trees:
    """A tree from the start and one from all goals."""

    space: JointSpace
    start: Vector
    goals: Vector
    stops: list[Stop] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.start_tree, self.goal_tree = Tree(self.start[None]), Tree(self.goals)

    def grow(self, budget: Budget, rng: np.random.Generator, patience: int) -> Bridge | Gap:
        """Grow the trees in turn until they meet.

        An iteration extends one tree by a step towards a random configuration; then the other one goes straight
        towards the new node for as long as it is free.
        """
        step = STEP * self.space.diagonal
        grown, other = self.start_tree, self.goal_tree
        for _ in range(patience):
            if not budget.spend():
                break
            new = self._extend(grown, self.space.sample(rng), step)
            met = None if new is None else self._approach(other, grown[new], step)
            if new is not None and met is not None:
                from_start, from_goal = (new, met) if grown is self.start_tree else (met, new)
                return self._join(from_start, from_goal)
            grown, other = other, grown
        nearest = min((stop.gap for stop in self.stops), default=np.inf)
        at_first = float(np.linalg.norm(self.goals - self.start, axis=1).min())
        return Gap(min(nearest, at_first), len(self.start_tree), len(self.goal_tree), tuple(self.stops))

    def _extend(self, tree: Tree, target: Vector, step: float) -> int | None:
        """Add a node one step from the nearest one towards `target`, where that is free."""
        base = tree.nearest(target)
        configuration = self.space.step(tree[base], target, step)
        return tree.add(configuration, base) if self.space.obstacle(tree[base], configuration) is None else None

    def _approach(self, tree: Tree, target: Vector, step: float) -> int | None:
        """Add nodes as far as the straight line to `target` is free; the last one's number where it is `target`."""
        node = tree.nearest(target)
        line = self.space.advance(tree[node], target, step)
        for configuration in line.nodes:
            node = tree.add(configuration, node)
        if line.blocked is None:
            return node
        self.stops.append(Stop(line.blocked, float(np.linalg.norm(target - tree[node]))))
        return None

    def _join(self, from_start: int, from_goal: int) -> Bridge:
        """The path through two nodes at the same configuration."""
        there = self.start_tree.branch(from_start)[::-1]
        onward = self.goal_tree.branch(from_goal)
        waypoints = [self.start_tree.configurations(there), self.goal_tree.configurations(onward[1:])]
        return Bridge(np.vstack(waypoints), root=onward[-1])
