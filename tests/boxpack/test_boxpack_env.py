"""The contract of an Env, on the real simulator: answers depend on arguments alone."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from packing_world import BAR, POST, after, box, carried_out, pick, place, prepared, problem, refused

from llm3.types import Failure, MotionProblem
from llm3_boxpack.domain import BoxPack
from llm3_boxpack.env import BoxpackEnv

INSTANCE = problem(
    box("red_box", 0.39, -0.2), box("green_box", 0.39, 0.05, BAR), box("tan_box", 0.39, 0.3, POST, yaw=0.4)
)
OTHER = problem(box("red_box", 0.45, 0.0, BAR, yaw=1.0), box("blue_box", 0.5, 0.25))


Question = Callable[[BoxpackEnv], Any]
"""One call of an Env."""


def plain(answer: MotionProblem | Failure) -> Any:
    """All that can be compared of an answer; arrays as bytes, so that equal means equal to the bit."""
    if isinstance(answer, Failure):
        return answer, answer.stats
    samples = np.random.default_rng(5).uniform(answer.low, answer.high, (64, len(answer.low)))
    return (
        tuple(answer.goals),
        answer.before,
        answer.cost,
        *(a.tobytes() for a in (answer.start, answer.low, answer.high, answer.resolution)),
        answer.valid(samples).tobytes(),
        answer.explain(samples[0]),
        answer.explain(np.array(answer.goals[0].configuration)),
    )


def questions(env: BoxpackEnv) -> list[Question]:
    """Possible and impossible actions from several states, and whatever else an Env is asked."""
    start = env.reset()
    picked = after(env, start, pick("green_box"))
    placed = after(env, picked, place("green_box", 0.62, 0.0, 1.2))
    tries = [
        (start, pick("red_box")),
        (start, pick("tan_box")),
        (picked, pick("tan_box")),
        (picked, place("green_box", 0.62, 0.0, 1.2)),
        (picked, place("green_box", 0.39, -0.2)),
        (picked, place("green_box", 1.0, 1.0)),
        (picked, place("green_box", 0.77, 0.0)),
        (placed, pick("red_box")),
        (placed, pick("green_box")),
    ]
    asked: list[Question] = [
        lambda env, s=s, a=a, seed=seed: plain(env.prepare(s, a, np.random.default_rng(seed)))
        for seed, (s, a) in enumerate(tries)
    ]
    for s, a in tries:
        if isinstance(env.prepare(s, a, np.random.default_rng(0)), MotionProblem):
            motion, _ = carried_out(env, s, a)
            asked.append(lambda env, s=s, a=a, m=motion: env.apply(s, a, m))
    asked += [lambda env: env.reset(), lambda env: env.goal(placed)]
    asked += [lambda env, s=s: env.describe(s) for s in (start, picked, placed)]
    return asked


@pytest.fixture(scope="module")
def env(make) -> BoxpackEnv:
    return make(INSTANCE)


@pytest.fixture(scope="module")
def asked(env) -> list[Question]:
    return questions(env)


@pytest.fixture(scope="module")
def answers(env, asked) -> list[Any]:
    return [question(env) for question in asked]


@pytest.mark.parametrize("seed", range(3))
def test_the_order_of_the_questions_does_not_matter(env, asked, answers, seed):
    order = list(range(len(asked)))
    random.Random(seed).shuffle(order)
    for index in order:
        assert asked[index](env) == answers[index]


def test_another_env_on_the_same_workcell_does_not_matter(make, env, asked, answers):
    other = make(OTHER, 0.05)
    start = other.reset()
    for question, answer in zip(asked, answers, strict=True):
        carried_out(other, start, pick("blue_box"))
        assert question(env) == answer


def test_a_fresh_env_gives_the_same_answers_and_two_worlds_do_not_notice_each_other(domain: BoxPack, asked, answers):
    first, second = (domain.make(INSTANCE, {"robot": "panda", "walls": "0"}) for _ in range(2))
    for question, answer in zip(asked, answers, strict=True):
        assert question(second) == answer
        assert question(first) == answer
    first.close()
    assert asked[0](second) == answers[0]
    second.close()


def test_two_problems_of_the_planner_stay_right_side_by_side(env):
    start = env.reset()
    held = after(env, start, pick("green_box"))
    first, second = prepared(env, start, pick("red_box")), prepared(env, held, place("green_box", 0.62, 0.0))
    samples = np.random.default_rng(0).uniform(first.low, first.high, (200, 7))
    masks = first.valid(samples), second.valid(samples)
    assert not (masks[0] == masks[1]).all()
    for _ in range(3):
        assert (first.valid(samples) == masks[0]).all()
        assert (second.valid(samples) == masks[1]).all()


def test_a_reset_sets_the_instance_whatever_happened(env):
    start = env.reset()
    after(env, start, pick("red_box"), place("red_box", 0.6, 0.0))
    assert env.reset() == start
    assert start.held is None
    assert {name: pose.position for name, pose in start.poses.items()} == {
        "red_box": (0.39, -0.2, 0.035),
        "green_box": (0.39, 0.05, 0.035),
        "tan_box": (0.39, 0.3, 0.035),
    }
    assert start.configuration == pytest.approx((0.0, -0.7854, 0.0, -2.3562, 0.0, 1.5708, 0.7854))


def test_a_box_that_starts_over_the_tray_stands_on_it(make):
    env = make(problem(box("red_box", 0.65, 0.0)))
    assert env.reset().poses["red_box"].position == (0.65, 0.0, 0.045)
    assert env.goal(env.reset()).achieved


def test_a_failed_action_changes_nothing(env, answers):
    start = env.reset()
    held = after(env, start, pick("red_box"))
    before = env.describe(held), plain(env.prepare(held, place("red_box", 0.6, 0.0), np.random.default_rng(0)))
    for action in (pick("tan_box"), place("red_box", 1.0, 1.0), place("red_box", 0.39, 0.05)):
        refused(env, held, action)
    assert before == (
        env.describe(held),
        plain(env.prepare(held, place("red_box", 0.6, 0.0), np.random.default_rng(0))),
    )


def test_what_may_be_asked_of_it(env):
    assert [schema.name for schema in env.schemas] == ["pick", "place"]
    assert env.objects == ("red_box", "green_box", "tan_box")
    assert [(joint.name, joint.unit) for joint in env.joints] == [(f"panda_joint{i}", "rad") for i in range(1, 8)]


def test_it_closes_twice_and_prints_nothing(domain: BoxPack, capfd):
    env = domain.make(INSTANCE, {"robot": "panda", "walls": "0.03"})
    after(env, env.reset(), pick("red_box"))
    refused(env, env.reset(), place("red_box", 0.6, 0.0))
    env.close()
    env.close()
    assert capfd.readouterr().out == ""


def test_a_motion_that_does_not_fit_is_a_mistake_of_the_caller(env):
    start = env.reset()
    placing, _ = carried_out(env, after(env, start, pick("red_box")), place("red_box", 0.6, 0.0))
    with pytest.raises(ValueError) as error:
        env.apply(start, place("red_box", 0.6, 0.0), placing)
    assert str(error.value) == "nothing is held, so nothing can be placed"
    with pytest.raises(ValueError):
        env.apply(start, pick("red_box"), placing)
