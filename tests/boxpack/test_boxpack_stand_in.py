"""The rule-based stand-in: it reads what a prompt tells, and learns from feedback."""

from __future__ import annotations

from dataclasses import replace
from math import hypot

import numpy as np
import pytest
from feedback_traces import traces_of
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.parsing import parse_reply
from llm3.types import Action, Context, Entity, FailureKind, Feedback, Proposal, Remark, Sketch
from llm3_boxpack.actions import PICK, PLACE
from llm3_boxpack.packing import SAME_SPOT
from llm3_boxpack.stand_in import reply

NAMES = ("red_box", "blue_box", "green_box", "tan_box")
SIZES = {"red_box": (0.07, 0.07, 0.07), "blue_box": (0.07, 0.07, 0.07), "green_box": (0.105, 0.035, 0.07)}
STATE = (
    Entity("basket", {"center": (0.7, 0.0), "x range": (0.54, 0.86), "y range": (-0.105, 0.105), "floor height": 0.01}),
    *(
        Entity(name, {"position": (0.39, -0.4 + 0.3 * i, 0.035), "size": SIZES.get(name, (0.035, 0.035, 0.07))})
        for i, name in enumerate(NAMES)
    ),
)
CONTEXT = Context("Pack the boxes.", (PICK, PLACE), NAMES, STATE)
SKELETON = tuple(Sketch(action, (name,)) for name in reversed(NAMES) for action in ("pick", "place"))
COLLISION, FAR = FailureKind.GOAL_IN_COLLISION, FailureKind.UNREACHABLE
seeds = st.integers(0, 2**32)
some = settings(max_examples=20)
"""A reply weighs hundreds of spots, so that each example takes a while."""


def plan(context: Context, seed: int = 0) -> tuple[Action, ...]:
    """The plan in the reply; every item of it is a valid action."""
    proposal = parse_reply(
        reply(context, np.random.default_rng(seed)), context.actions, context.objects, context.skeleton
    )
    assert isinstance(proposal, Proposal), proposal
    assert proposal.repairs == ()
    assert proposal.reasoning
    assert all(isinstance(action, Action) for action in proposal.actions), proposal.actions
    return tuple(action for action in proposal.actions if isinstance(action, Action))


def placed(actions: tuple[Action, ...]) -> dict[str, Action]:
    return {action.objects[0]: action for action in actions if action.name == "place"}


def feedback(number: int, actions: tuple[Action, ...], failed: int, kind: FailureKind | None) -> Feedback:
    """All feasible up to the one that failed."""
    remarks = [Remark(str(action), "feasible") for action in actions[:failed]]
    remarks.append(Remark(str(actions[failed]), "failed", "as it says", kind))
    remarks += [Remark(str(action), "not tried") for action in actions[failed + 1 :]]
    return Feedback(number, tuple(remarks), "The goal is not reached: tan_box is not in the basket.")


def gap(a: Action, b: Action) -> float:
    """Free space between two placed boxes in metres, along the axis on which there is more of it."""

    def sides(action: Action) -> np.ndarray:
        dx, dy, _ = SIZES.get(action.objects[0], (0.035, 0.035, 0.07))
        return np.array((dy, dx) if abs(np.sin(action.params["theta"])) > 0.5 else (dx, dy))

    apart = np.abs([a.params["x"] - b.params["x"], a.params["y"] - b.params["y"]])
    return float((apart - (sides(a) + sides(b)) / 2).max())


@pytest.fixture(scope="module")
def first() -> tuple[Action, ...]:
    return plan(CONTEXT)


actions = st.one_of(
    st.builds(lambda n: Action("pick", (n,)), st.sampled_from(NAMES)),
    st.builds(
        lambda n, x, y, t: Action("place", (n,), {"x": x, "y": y, "theta": t}),
        st.sampled_from(NAMES),
        st.floats(0.0, 1.0),
        st.floats(-1.0, 1.0),
        st.floats(-3.14, 3.14),
    ),
)
traces = traces_of(actions)


@some
@given(traces, seeds)
def test_whatever_the_trace_it_writes_a_whole_plan_of_valid_actions(trace, seed):
    actions = plan(replace(CONTEXT, trace=trace), seed)
    assert [a.name for a in actions] == ["pick", "place"] * len(NAMES)
    assert sorted(a.objects[0] for a in actions[::2]) == sorted(NAMES)
    assert [a.objects for a in actions[::2]] == [a.objects for a in actions[1::2]]


@some
@given(traces, seeds, st.permutations(SKELETON[::2]))
def test_a_given_sequence_is_kept(trace, seed, order):
    skeleton = tuple(Sketch(name, sketch.objects) for sketch in order for name in ("pick", "place"))
    actions = plan(replace(CONTEXT, trace=trace, skeleton=skeleton), seed)
    assert [(a.name, a.objects) for a in actions] == [(s.name, s.objects) for s in skeleton]


@some
@given(traces, seeds)
def test_the_same_context_and_seed_give_the_same_reply(trace, seed):
    context = replace(CONTEXT, trace=trace)
    assert reply(context, np.random.default_rng(seed)) == reply(context, np.random.default_rng(seed))


@some
@given(seeds)
def test_the_first_plan_packs_all_boxes_into_the_basket_without_overlap(seed):
    spots = list(placed(plan(CONTEXT, seed)).values())
    for index, spot in enumerate(spots):
        assert 0.54 < spot.params["x"] < 0.86
        assert -0.105 < spot.params["y"] < 0.105
        assert all(gap(spot, other) > 0 for other in spots[:index])


def test_it_needs_nothing_of_the_context_but_what_the_prompt_shows():
    """Neither the prose nor what a box's pose is matters: names, sizes and the basket do."""
    bare = replace(
        CONTEXT,
        task="",
        state=tuple(
            Entity(e.name, {k: v for k, v in e.properties.items() if k in ("size", "x range", "y range")})
            for e in STATE
        ),
    )
    assert plan(bare) == plan(CONTEXT)


@pytest.mark.parametrize("level", ["categorized", "binary", "none"])
def test_it_works_with_every_feedback_level(solve, level):
    result, _ = solve(setting="hard-small", seed=2, feedback=level, max_llm_calls=4)
    assert len(result.attempts) > 1
    for attempt in result.attempts:
        assert attempt.unreadable is None
        assert all(isinstance(action, Action) for action in attempt.proposal.actions)


def test_it_works_where_the_sequence_is_given(solve):
    result, _ = solve(setting="easy-medium", seed=0, strategy="sample-params")
    assert result.solved


class TestLearning:
    def next_plan(self, *trace: Feedback, seed: int = 1) -> tuple[Action, ...]:
        return plan(replace(CONTEXT, trace=trace), seed)

    @pytest.mark.parametrize("kind", [COLLISION, FAR, FailureKind.NO_PATH, None])
    def test_it_keeps_what_worked_and_avoids_the_spot_that_failed(self, first, kind):
        for seed in range(20):
            again = self.next_plan(feedback(1, first, 5, kind), seed=seed)
            assert again[:4] == first[:4]
            failed = first[5]
            new = placed(again)[failed.objects[0]]
            distance = hypot(new.params["x"] - failed.params["x"], new.params["y"] - failed.params["y"])
            assert distance > SAME_SPOT

    def test_it_leaves_more_room_after_each_collision(self, first):
        widest = []
        trace: tuple[Feedback, ...] = ()
        for number in range(1, 4):
            gaps = []
            for seed in range(20):
                actions = self.next_plan(*trace, seed=seed)
                kept = list(placed(actions).values())
                gaps.append(min(gap(kept[2], other) for other in kept[:2]))
            widest.append(float(np.median(gaps)))
            trace = (*trace, feedback(number, first, 5, COLLISION))
        assert widest == sorted(widest)
        assert widest[-1] > widest[0] + 0.02

    def test_after_a_spot_was_out_of_reach_it_stays_closer_to_the_arm(self, first):
        far = Action("place", (first[5].objects[0],), {"x": 0.75, "y": 0.0, "theta": 0.0})
        tried = (*first[:5], far, *first[6:])
        for seed in range(20):
            params = placed(self.next_plan(feedback(1, tried, 5, FAR), seed=seed))[far.objects[0]].params
            assert hypot(params["x"], params["y"]) < 0.75

    def test_when_it_is_stuck_it_gives_up_the_placement_before(self, first):
        stuck = tuple(feedback(number, first, 5, COLLISION) for number in (1, 2, 3))
        for seed in range(20):
            again = self.next_plan(*stuck, seed=seed)
            assert again[:2] == first[:2]
            assert placed(again)[first[3].objects[0]] != first[3]

    def test_a_box_that_could_not_be_picked_up_comes_last(self, first):
        name = first[4].objects[0]
        again = self.next_plan(feedback(1, first, 4, COLLISION))
        assert again[-1].objects[0] == name

    def test_a_plan_that_worked_but_missed_the_goal_is_made_anew(self, first):
        worked = Feedback(1, tuple(Remark(str(action), "feasible") for action in first), "not in the basket")
        assert placed(self.next_plan(worked)) != placed(first)


def test_random_parameters_within_the_region_run_end_to_end(solve):
    result, _ = solve(setting="medium-small", seed=0, llm="random", strategy="sample-params", max_llm_calls=1)
    (attempt,) = result.attempts
    assert result.stats.llm_calls == 1
    assert result.stats.motion_calls >= 2
    sequence = [(action.name, action.objects) for action in attempt.proposal.actions]
    names = ("cyan_box", "blue_box", "red_box", "yellow_box")
    assert sequence == [(action, (name,)) for name in names for action in ("pick", "place")]
    for action in attempt.proposal.actions[1::2]:
        assert 0.54 <= action.params["x"] <= 0.76
        assert -0.105 <= action.params["y"] <= 0.105
