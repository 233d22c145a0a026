"""Goals are made when they are looked at, once, and count from the first."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from llm3.errors import PluginError
from llm3.types import Goal, Goals, MotionProblem, Stats

numbers = st.lists(st.floats(-3, 3), min_size=1, max_size=6)


class Workshop:
    """Makes goals, and counts them."""

    def __init__(self, values):
        self.values, self.made = values, 0

    def goals(self):
        for value in self.values:
            self.made += 1
            yield Goal((value,))

    def cost(self):
        return Stats(ik_calls=self.made)


@given(values=numbers, data=st.data())
def test_looking_at_a_goal_makes_it_and_those_before_it(values, data):
    workshop = Workshop(values)
    goals = Goals(workshop.goals(), workshop.cost)
    assert workshop.made == 1
    index = data.draw(st.integers(0, len(values) - 1))
    assert goals[index] == Goal((values[index],))
    assert goals.stats == Stats(ik_calls=index + 1)


@given(values=numbers)
def test_they_are_the_sequence_that_was_given(values):
    workshop = Workshop(values)
    goals, plain = Goals(workshop.goals()), [Goal((value,)) for value in values]
    assert list(goals) == list(goals) == plain
    assert len(goals) == len(plain)
    assert goals[-1] == plain[-1]
    assert list(goals[1:]) == plain[1:]
    assert workshop.made == len(values)
    with pytest.raises(IndexError):
        goals[len(values)]


def test_there_must_be_one():
    with pytest.raises(ValueError, match=r"^a motion problem needs at least one goal$"):
        Goals(())


def test_they_must_be_alike():
    goals = Goals(iter((Goal((0.0,)), Goal((0.0, 1.0)))))
    sentence = (
        "making goal 1 raised ValueError: all goals of a motion problem must have the same number of joint values"
    )
    with pytest.raises(PluginError, match=f"^{sentence}$"):
        len(goals)


def test_what_fails_while_goals_are_made_is_the_fault_of_who_makes_them() -> None:
    def one_and_no_more():
        yield Goal((0.0,))
        raise ZeroDivisionError("no more")

    goals = Goals(one_and_no_more())
    assert goals[0] == Goal((0.0,))
    for _ in range(2):
        with pytest.raises(PluginError, match=r"^making goal 1 raised ZeroDivisionError: no more$"):
            len(goals)


# ---- limits --------------------------------------------------------------------------------------------------------

TOO_FAR = (
    "joint value 0 of {} is {:g}, outside of its limits -1 to 1: refuse an action that would need it, or widen `low` "
    "and `high`"
)


def problem(start: float, goals) -> MotionProblem:
    return MotionProblem((start,), goals, low=-1.0, high=1.0, valid=lambda samples: samples[:, 0] < 9, resolution=0.1)


@given(start=st.floats(-1, 1), values=st.lists(st.floats(-1, 1), min_size=1))
def test_ends_lie_within_the_limits(start, values):
    goals = problem(start, Goals(map(Goal, [(value,) for value in values]))).goals
    assert [goal.configuration for goal in goals] == [(value,) for value in values]


@given(beyond=st.floats(2e-4, 1e6))
def test_an_end_outside_of_the_limits_is_refused(beyond):
    for start, ends, what in ((-1 - beyond, (0.0,), "the start"), (0.0, (0.5, 1 + beyond), "a goal")):
        with pytest.raises(ValueError, match="outside of its limits") as caught:
            problem(start, [Goal((end,)) for end in ends])
        assert str(caught.value) == TOO_FAR.format(what, float(f"{(start if ends == (0.0,) else ends[1]):.6g}"))


def test_a_goal_outside_of_the_limits_is_refused_when_it_is_made() -> None:
    workshop = Workshop([0.5, 3.0])
    goals = problem(0.0, Goals(workshop.goals(), workshop.cost)).goals
    assert workshop.made == 1
    assert goals[0] == Goal((0.5,))
    with pytest.raises(PluginError) as caught:
        goals[1]
    assert str(caught.value) == f"making goal 1 raised ValueError: {TOO_FAR.format('a goal', 3)}"


def test_the_rounding_of_states_may_lead_a_little_beyond() -> None:
    assert problem(1.0001, [Goal((-1.0001,))]).start == (1.0001,)


def test_the_cost_of_goals_is_told_by_their_problem() -> None:
    workshop = Workshop([0.5, 0.6])
    asked = problem(0.0, Goals(workshop.goals(), workshop.cost))
    assert asked.cost == Stats(ik_calls=1)
    assert len(asked.goals) == 2
    assert asked.cost == Stats(ik_calls=2)
