"""The kit finds each fault that is planted in a motion planner, and says what it is and what may be the cause."""

from __future__ import annotations

import pytest
from broken_planners import BUDGET, FAULTS, ByTheWay

from llm3.testing import check_planner


def test_a_planner_without_a_fault_has_no_complaint():
    assert check_planner(ByTheWay(), max_iterations=BUDGET) == ()


@pytest.mark.parametrize("fault", FAULTS)
def test_each_fault_is_found_and_named(fault):
    planted = FAULTS[fault]
    complaints = check_planner(planted.plugin, max_iterations=BUDGET)
    assert planted.found_in(complaints), "\n".join(f"{c.rule}: {c}" for c in complaints)
