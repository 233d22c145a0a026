"""The rule-based stand-in: it reads what a prompt tells, and learns from feedback."""

from __future__ import annotations

from dataclasses import replace
from math import dist, hypot

import numpy as np
import pytest
from feedback_traces import traces_of
from hypothesis import example, given, settings
from hypothesis import strategies as st

from llm3.parsing import parse_reply
from llm3.types import Action, Context, Entity, FailureKind, Feedback, Proposal, Remark, Sketch
from llm3_blocks.actions import PICK, PLACE, STACK
from llm3_blocks.places import SAME_PLACE
from llm3_blocks.stand_in import reply

SIZE = (0.05, 0.05, 0.05)


def block(name: str, x: float, y: float, level: int, support: str) -> Entity:
    position = (x, y, 0.025 + 0.05 * level)
    return Entity(name, {"position": position, "size": SIZE, "theta": 0.0, "stands on": support})


NAMES = ("a", "b", "c", "d")
STATE = (
    block("a", 0.45, 0.1, 0, "table"),
    block("b", 0.45, 0.1, 1, "a"),
    block("c", 0.45, 0.1, 2, "b"),
    block("d", 0.45, -0.1, 0, "table"),
)
TASK = "Towers.\nThe goal: on(d, table), on(c, d), on(b, c), on(a, b). Here on(x, y) means that x rests on y."
CONTEXT = Context(TASK, (PICK, PLACE, STACK), NAMES, STATE)
OTHER = replace(CONTEXT, task="The goal: on(a, table), on(c, a), on(d, c), on(b, table).")
"""In it two blocks have to be put down on the table."""
COLLISION, FAR = FailureKind.GOAL_IN_COLLISION, FailureKind.UNREACHABLE
seeds = st.integers(0, 2**32)
some = settings(max_examples=20)


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


def sketches(actions: tuple[Action, ...]) -> list[str]:
    return [f"{a.name} {' '.join(a.objects)}" for a in actions]


def places(actions: tuple[Action, ...]) -> dict[str, tuple[float, float]]:
    return {a.objects[0]: (a.params["x"], a.params["y"]) for a in actions if a.name == "place"}


def feedback(number: int, actions: tuple[Action, ...], failed: int, kind: FailureKind | None) -> Feedback:
    """All feasible up to the one that failed."""
    remarks = [Remark(str(action), "feasible") for action in actions[:failed]]
    remarks.append(Remark(str(actions[failed]), "failed", "as it says", kind))
    remarks += [Remark(str(action), "not tried") for action in actions[failed + 1 :]]
    return Feedback(number, tuple(remarks), "The goal is not reached: a is not on b.")


def after(actions: tuple[Action, ...], failed: int, kind: FailureKind | None, context: Context = OTHER) -> Context:
    return replace(context, trace=(feedback(1, actions, failed, kind),))


actions = st.one_of(
    st.builds(lambda n: Action("pick", (n,)), st.sampled_from(NAMES)),
    st.builds(lambda n, m: Action("stack", (n, m)), st.sampled_from(NAMES), st.sampled_from(NAMES)),
    st.builds(
        lambda n, x, y, t: Action("place", (n,), {"x": x, "y": y, "theta": t}),
        st.sampled_from(NAMES),
        st.floats(0.0, 1.0),
        st.floats(-1.0, 1.0),
        st.floats(-3.14, 3.14),
    ),
)
traces = traces_of(actions)


ON_B = (Action("stack", ("a", "b")),)
"""An action that, where it fails, makes the stand-in move b, which stands on another block."""


@some
@given(traces, seeds, st.sampled_from([CONTEXT, OTHER]))
@example((feedback(1, ON_B, 0, None), feedback(2, ON_B, 0, None)), 0, OTHER)
def test_whatever_the_trace_its_moves_lead_to_the_goal(trace, seed, context):
    below = {entity.name: entity.properties["stands on"] for entity in STATE}
    held = ""
    for action in plan(replace(context, trace=trace), seed):
        name = action.objects[0]
        if action.name == "pick":
            assert not held
            assert name not in below.values()
            held = name
            del below[name]
        else:
            assert name == held
            below[name], held = ("table" if action.name == "place" else action.objects[1]), ""
    goals = {"d": "table", "c": "d", "b": "c", "a": "b"}, {"a": "table", "c": "a", "d": "c", "b": "table"}
    assert below == goals[context is OTHER]


@some
@given(traces, seeds)
def test_a_given_sequence_is_kept(trace, seed):
    skeleton = (Sketch("pick", ("d",)), Sketch("place", ("d",)), Sketch("pick", ("c",)), Sketch("stack", ("c", "d")))
    found = plan(replace(CONTEXT, trace=trace, skeleton=skeleton), seed)
    assert [(a.name, a.objects) for a in found] == [(s.name, s.objects) for s in skeleton]


@some
@given(traces, seeds)
def test_the_same_context_and_seed_give_the_same_reply(trace, seed):
    context = replace(OTHER, trace=trace)
    assert reply(context, np.random.default_rng(seed)) == reply(context, np.random.default_rng(seed))


def test_it_builds_from_the_bottom_up():
    assert sketches(plan(CONTEXT)) == [
        *("pick c", "stack c d"),
        *("pick b", "stack b c"),
        *("pick a", "stack a b"),
    ]


@some
@given(seeds)
def test_it_takes_apart_what_is_in_the_way_and_puts_it_where_nothing_stands(seed):
    found = plan(OTHER, seed)
    assert sketches(found)[:4] == ["pick c", "place c", "pick b", "place b"]
    spots = [*places(found).values(), (0.45, 0.1), (0.45, -0.1)]
    for index, spot in enumerate(spots):
        assert all(dist(spot, other) > 0.0707 for other in spots[:index])


def test_it_needs_nothing_of_the_context_but_what_the_prompt_shows():
    bare = replace(
        OTHER,
        state=tuple(
            Entity(e.name, {k: v for k, v in e.properties.items() if k in ("position", "size", "stands on")})
            for e in STATE
        ),
    )
    assert plan(bare) == plan(OTHER)


class TestLearning:
    @pytest.mark.parametrize("kind", [COLLISION, FAR, FailureKind.NO_PATH, None])
    def test_it_keeps_what_worked_and_avoids_the_place_that_failed(self, kind):
        first = plan(OTHER)
        for seed in range(20):
            again = plan(after(first, 3, kind), seed)
            assert again[:3] == first[:3]
            assert dist(places(again)["b"], places(first)["b"]) > SAME_PLACE

    def test_after_a_collision_it_leaves_more_room(self):
        first = plan(OTHER)

        def room(context: Context) -> float:
            nearest = []
            for seed in range(20):
                spot = places(plan(context, seed))["c"]
                nearest.append(min(dist(spot, stands) for stands in ((0.45, 0.1), (0.45, -0.1))))
            return float(np.median(nearest))

        assert room(after(first, 1, COLLISION)) > room(OTHER) + 0.02

    def test_after_a_place_was_out_of_reach_it_stays_closer_to_the_arm(self):
        first = plan(OTHER)
        far = Action("place", ("c",), {"x": 0.5, "y": 0.0, "theta": 0.0})
        for seed in range(20):
            again = plan(after((first[0], far, *first[2:]), 1, FAR), seed)
            assert all(hypot(*place) < 0.5 for place in places(again).values())

    @pytest.mark.parametrize("kind", [COLLISION, FAR, None])
    def test_a_tower_that_stands_badly_is_built_elsewhere(self, kind):
        """The lowest block of the goal's tower is moved, although it belongs on the table and stands there."""
        first = plan(CONTEXT)
        again = plan(after(first, 3, kind, CONTEXT))
        assert sketches(again)[:2] == ["pick d", "place d"]

    def test_where_the_fingers_have_no_room_the_neighbour_is_moved_away(self):
        first = plan(CONTEXT)
        alone = (block("a", 0.45, 0.1, 0, "table"), block("d", 0.45, 0.02, 0, "table"))
        context = Context("The goal: on(a, d), on(d, table).", CONTEXT.actions, ("a", "d"), alone)
        first = plan(context)
        assert sketches(first) == ["pick a", "stack a d"]
        assert sketches(plan(after(first, 0, COLLISION, context)))[:2] == ["pick d", "place d"]

    def test_where_that_happens_again_all_is_taken_apart_and_built_in_step(self):
        first = plan(OTHER)
        twice = tuple(feedback(number, first, 0, COLLISION) for number in (1, 2))
        again = plan(replace(OTHER, trace=twice))
        highest = {entity.name: entity.properties["position"][2] for entity in STATE}
        taken = [action.objects[0] for action in again if action.name == "pick"][: len(STATE)]
        assert taken == sorted(taken, key=lambda name: (-highest[name], name))
        went_on = feedback(3, again, 5, COLLISION)
        assert sketches(plan(replace(OTHER, trace=(went_on,)))) == sketches(again)

    def test_a_plan_that_worked_but_missed_the_goal_is_made_anew(self):
        first = plan(OTHER)
        worked = Feedback(1, tuple(Remark(str(action), "feasible") for action in first), "a is not on b")
        assert places(plan(replace(OTHER, trace=(worked,)), 1)) != places(first)

    def test_what_does_not_change_is_given_up(self):
        first = plan(OTHER)
        stuck = tuple(feedback(number, first, 3, COLLISION) for number in (1, 2, 3))
        assert places(plan(replace(OTHER, trace=stuck), 1))["c"] != places(first)["c"]


@pytest.mark.parametrize("level", ["categorized", "binary", "none"])
def test_it_works_with_every_feedback_level(solve, level):
    result, _ = solve(setting="blocks-4", seed=7, feedback=level, max_llm_calls=4)
    for attempt in result.attempts:
        assert attempt.unreadable is None
        assert all(isinstance(action, Action) for action in attempt.proposal.actions)


def test_it_works_where_the_sequence_is_given_and_so_does_the_random_sampler(solve):
    assert solve(setting="blocks-4", seed=0, strategy="sample-params")[0].solved
    assert solve(setting="blocks-3", seed=0, strategy="sample-params", llm="random", max_llm_calls=50)[0].solved
