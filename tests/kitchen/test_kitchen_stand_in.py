"""The rule-based stand-in: it reads what a prompt tells, and moves what the feedback names."""

from __future__ import annotations

from dataclasses import replace
from math import hypot

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.parsing import parse_reply
from llm3.types import Action, Context, Entity, FailureKind, Feedback, Proposal, Remark
from llm3_kitchen.actions import HEAT, PICK, PLACE, WASH
from llm3_kitchen.lessons import PATIENCE
from llm3_kitchen.spots import SAME_SPOT
from llm3_kitchen.stand_in import reply

RANGES = {
    "store": ((0.48, 0.72), (-0.33, 0.33)),
    "sink": ((0.29, 0.47), (0.3, 0.46)),
    "stove": ((0.29, 0.47), (-0.46, -0.3)),
    "worktop": ((-0.27, 0.23), (-0.69, -0.43)),
    "serving": ((-0.27, 0.23), (0.41, 0.71)),
}
GOALS = {"leek": "washed, heated, served", "potato": "washed, served", "bread": "served"}
SIZES = {"leek": (0.15, 0.035, 0.035), "potato": (0.05, 0.05, 0.045), "bread": (0.1, 0.065, 0.06)}
CLUTTER = ("jar", "bottle")
STATE = (
    *(Entity(name, {"kind": name, "x range": x, "y range": y}) for name, (x, y) in RANGES.items()),
    *(
        Entity(name, {"position": (0.6, -0.2 + 0.2 * i, 0.02), "size": SIZES[name], "theta": 0.1, "goal": GOALS[name]})
        for i, name in enumerate(GOALS)
    ),
    Entity("jar", {"position": (0.6, -0.14, 0.05), "size": (0.06, 0.06, 0.1), "theta": 0.0}),
    Entity("bottle", {"position": (0.6, 0.25, 0.08), "size": (0.045, 0.045, 0.16), "theta": 0.0}),
)
NAMES = (*GOALS, *CLUTTER, *RANGES)
CONTEXT = Context("Cook.", (PICK, PLACE, WASH, HEAT), NAMES, STATE)
COLLISION, FAR = FailureKind.GOAL_IN_COLLISION, FailureKind.UNREACHABLE
seeds = st.integers(0, 2**32)
some = settings(max_examples=10)


def plan(context: Context, seed: int = 0) -> tuple[Action, ...]:
    """The plan in the reply; every item of it is a valid action."""
    proposal = parse_reply(reply(context, np.random.default_rng(seed)), context.actions, context.objects)
    assert isinstance(proposal, Proposal), proposal
    assert proposal.repairs == ()
    assert proposal.reasoning
    assert all(isinstance(action, Action) for action in proposal.actions), proposal.actions
    return tuple(action for action in proposal.actions if isinstance(action, Action))


def short(actions: tuple[Action, ...]) -> list[str]:
    """Such as ``"place leek sink"``."""
    return [" ".join((action.name, *action.objects)) for action in actions]


def feedback(actions: tuple[Action, ...], failed: int, kind: FailureKind | None, text: str = "") -> Feedback:
    """All feasible up to the one that failed."""
    remarks = [Remark(str(action), "feasible") for action in actions[:failed]]
    remarks.append(Remark(str(actions[failed]), "failed", text, kind))
    remarks += [Remark(str(action), "not tried") for action in actions[failed + 1 :]]
    return Feedback(1, tuple(remarks), "The goal is not reached.")


def after(*trace: Feedback, seed: int = 1) -> tuple[Action, ...]:
    return plan(replace(CONTEXT, trace=trace), seed)


def is_sensible(actions: tuple[Action, ...]) -> bool:
    """Whether a plan could work if nothing were in the way: the symbolic half of the task."""
    held, where, done = None, dict.fromkeys((*GOALS, *CLUTTER), "store"), set()
    for action in actions:
        name = action.objects[0]
        if action.name == "pick":
            if held is not None:
                return False
            held = name
        elif action.name == "place":
            if held != name:
                return False
            held, where[name] = None, action.objects[1]
        else:
            needed = {"wash": "sink", "heat": "stove"}[action.name]
            raw = action.name == "heat" and (name, "wash") not in done
            if held or where[name] != needed or raw:
                return False
            done.add((name, action.name))
    wanted = {("leek", "wash"), ("leek", "heat"), ("potato", "wash")}
    return wanted <= done and all(where[name] == "serving" for name in GOALS)


@pytest.fixture(scope="module")
def first() -> tuple[Action, ...]:
    return plan(CONTEXT)


@some
@given(seeds)
def test_the_first_plan_does_all_that_is_asked_for_in_an_order_that_makes_sense(seed):
    actions = plan(CONTEXT, seed)
    assert is_sensible(actions)
    assert not any(action.objects[0] in CLUTTER for action in actions)


def test_what_leaves_no_room_in_the_sink_is_put_aside_first():
    in_sink = Entity("bottle", {"position": (0.38, 0.38, 0.08), "size": (0.16, 0.14, 0.16), "theta": 0.0})
    state = tuple(in_sink if entity.name == "bottle" else entity for entity in STATE)
    told = short(plan(replace(CONTEXT, state=state)))
    first = next(index for index, action in enumerate(told) if action.endswith(" sink"))
    assert told[first - 3 : first - 1] == ["pick bottle", "place bottle worktop"]
    assert sum(action == "pick bottle" for action in told) == 1


@some
@given(seeds)
def test_the_same_context_and_seed_give_the_same_reply(seed):
    assert reply(CONTEXT, np.random.default_rng(seed)) == reply(CONTEXT, np.random.default_rng(seed))


@some
@given(seeds, st.integers(0, 40), st.sampled_from([None, *FailureKind]), st.sampled_from(["", *NAMES]))
def test_whatever_failed_the_next_plan_makes_sense_as_well(seed, failed, kind, text):
    actions = plan(CONTEXT, seed)
    assert is_sensible(after(feedback(actions, failed % len(actions), kind, text), seed=seed))


some_actions = st.one_of(
    st.builds(lambda verb, n: Action(verb, (n,)), st.sampled_from(["pick", "wash", "heat"]), st.sampled_from(NAMES)),
    st.builds(
        lambda n, p, x, y: Action("place", (n, p), {"x": x, "y": y, "theta": 0.0}),
        st.sampled_from(NAMES),
        st.sampled_from(NAMES),
        st.floats(-0.8, 0.8),
        st.floats(-0.8, 0.8),
    ),
)
remarks = st.builds(
    Remark,
    st.one_of(some_actions.map(str), st.text(max_size=20), st.just("place(['nobody'], {'x': 1})")),
    st.sampled_from(["feasible", "failed", "not tried"]),
    st.one_of(st.text(max_size=20), st.sampled_from(NAMES)),
    st.sampled_from([None, *FailureKind]),
)
traces = st.lists(
    st.builds(Feedback, st.integers(1, 20), st.lists(remarks, max_size=8).map(tuple), st.text(max_size=20)), max_size=5
).map(tuple)


@settings(max_examples=30)
@given(traces, seeds)
def test_whatever_the_trace_it_writes_a_plan_of_valid_actions(trace, seed):
    plan(replace(CONTEXT, trace=trace), seed)


def test_it_needs_nothing_of_the_context_but_what_the_prompt_shows(first):
    bare = replace(CONTEXT, task="")
    assert plan(bare) == first


class TestLearning:
    def test_what_the_feedback_names_is_moved_away_first(self, first):
        index = short(first).index("pick leek")
        text = "The goal configuration is in collision with jar (touched by the gripper)."
        actions = after(feedback(first, index, COLLISION, text))
        assert actions[:index] == first[:index]
        assert short(actions)[index : index + 3] == ["pick jar", "place jar worktop", "pick leek"]

    def test_food_that_is_in_the_way_is_served_first(self, first):
        index = next(i for i, action in enumerate(first) if action.name == "pick")
        name = first[index].objects[0]
        other = next(food for food in GOALS if food != name)
        actions = after(feedback(first, index, COLLISION, f"in collision with {other}"))
        assert short(actions)[index] == f"pick {other}"
        assert f"place {other} serving" in short(actions)[: short(actions).index(f"pick {name}")]

    def test_without_a_name_what_stands_nearest_is_moved(self, first):
        index = short(first).index("pick leek")
        assert short(after(feedback(first, index, None)))[index : index + 2] == ["pick jar", "place jar worktop"]

    @pytest.mark.parametrize("kind", [COLLISION, FAR, FailureKind.NO_PATH, None])
    def test_a_spot_that_failed_is_given_up_for_another_one(self, first, kind):
        index = short(first).index("place bread serving")
        actions = after(feedback(first, index, kind, "carrot"))
        assert actions[:index] == first[:index]
        new, old = actions[index], first[index]
        assert new.objects == old.objects
        assert hypot(new.params["x"] - old.params["x"], new.params["y"] - old.params["y"]) > SAME_SPOT

    def test_what_was_put_where_it_cannot_be_taken_again_is_put_elsewhere(self, first):
        index = short(first).index("pick leek", short(first).index("wash leek"))
        actions = after(feedback(first, index, COLLISION, "in collision with sink_left"))
        begins = short(first).index("pick leek")
        assert actions[:begins] == first[:begins]
        places = [a for plan in (first, actions) for a in plan if short((a,)) == ["place leek sink"]]
        (old, new) = places
        assert hypot(new.params["x"] - old.params["x"], new.params["y"] - old.params["y"]) > SAME_SPOT

    def test_after_some_failures_behind_the_same_beginning_the_last_move_goes_too(self, first):
        moves = [i for i, action in enumerate(first) if action.name == "pick"]
        failed = moves[2]
        same = feedback(first, failed, COLLISION, "jar")
        assert after(*[same] * (PATIENCE - 1))[:failed] == first[:failed]
        assert after(*[same] * PATIENCE)[: moves[1]] == first[: moves[1]]
        assert after(*[same] * PATIENCE)[:failed] != first[:failed]

    def test_a_plan_that_worked_and_did_not_reach_the_goal_is_made_anew(self, first):
        done = Feedback(1, tuple(Remark(str(action), "feasible") for action in first), "leek is not served")
        assert is_sensible(after(done))
