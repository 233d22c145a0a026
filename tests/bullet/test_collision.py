from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plain_verdict import PlainWorld
from random_worlds import random_configurations, random_scene

from llm3_bullet.clients import connect
from llm3_bullet.collision import CollisionChecker

ROBOTS = ("panda", "iiwa", "toy")
CLEARANCES = (0.0, 0.005, -0.0005)
"""In metres; a negative one lets things penetrate a little."""
seeds = st.integers(0, 2**32 - 1)


def disagreements(checker: CollisionChecker, rng: np.random.Generator, held: bool, count: int) -> int:
    """How many of the fast verdicts in a random scene are not PyBullet's, at one of the clearances."""
    scene = random_scene(checker.kinematics, rng, held)
    view = checker.view(scene)
    Q = random_configurations(checker.kinematics, count, rng)
    clearance = float(rng.choice(CLEARANCES))
    return int((view.valid(Q, clearance) != view.valid(Q, clearance, coarse=False)).sum())


@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("robot", ROBOTS)
def test_the_fast_verdict_is_the_verdict_of_pybullet_alone(checkers, robot, held):
    for seed in range(20):
        assert disagreements(checkers[robot], np.random.default_rng(seed), held, 250) == 0, f"seed {seed}"


@pytest.mark.slow
@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("robot", ROBOTS)
def test_the_fast_verdict_is_the_verdict_of_pybullet_alone_in_many_worlds(checkers, robot, held):
    for seed in range(1000, 1200):
        assert disagreements(checkers[robot], np.random.default_rng(seed), held, 500) == 0, f"seed {seed}"


@pytest.mark.parametrize("held", [False, True])
@pytest.mark.parametrize("robot", ROBOTS)
def test_the_verdict_is_that_of_plain_pybullet_calls(checkers, descriptions, robot, held):
    checker = checkers[robot]
    verdicts = []
    for seed in range(6):
        rng = np.random.default_rng(seed)
        scene = random_scene(checker.kinematics, rng, held)
        Q = random_configurations(checker.kinematics, 40, rng)
        with connect() as client:
            world = PlainWorld(client, descriptions[robot], scene)
            for clearance in CLEARANCES:
                expected = [world.free(q, clearance) for q in Q]
                assert checker.view(scene).valid(Q, clearance).tolist() == expected, f"seed {seed}"
                verdicts += expected
    assert 0.1 < np.mean(verdicts) < 0.9  # or the agreement would say little


@settings(max_examples=15, deadline=None)
@given(seed=seeds, robot=st.sampled_from(ROBOTS))
def test_a_verdict_depends_on_no_other_configuration_and_no_other_scene(checkers, seed, robot):
    checker, rng = checkers[robot], np.random.default_rng(seed)
    views = [checker.view(random_scene(checker.kinematics, rng, held)) for held in (False, True)]
    Q = random_configurations(checker.kinematics, 60, rng)
    together = [view.valid(Q, 0.002) for view in views]
    order = rng.permutation(len(Q))
    for size in (1, 2, 7):
        for chosen in np.array_split(order, range(size, len(order), size)):
            for view, expected in zip(views, together, strict=True):
                assert (view.valid(Q[chosen], 0.002) == expected[chosen]).all()


@settings(max_examples=15, deadline=None)
@given(seed=seeds, robot=st.sampled_from(ROBOTS))
def test_reasons_depend_on_no_history_to_the_last_bit(checkers, descriptions, seed, robot):
    checker, rng = checkers[robot], np.random.default_rng(seed)
    scenes = [random_scene(checker.kinematics, rng, held) for held in (False, True)]
    Q = random_configurations(checker.kinematics, 8, rng)
    first = [[checker.view(scene).contacts(q, 0.005) for q in Q] for scene in scenes]
    views = [checker.view(scene) for scene in scenes]
    for i in rng.permutation(len(Q)):
        for view, contacts in zip(views, first, strict=True):
            assert view.contacts(Q[i], 0.005) == contacts[i]


@settings(max_examples=15, deadline=None)
@given(seed=seeds, robot=st.sampled_from(ROBOTS), held=st.booleans(), clearance=st.sampled_from(CLEARANCES))
def test_within_the_limits_a_configuration_is_invalid_if_and_only_if_there_is_a_reason(
    checkers, seed, robot, held, clearance
):
    checker, rng = checkers[robot], np.random.default_rng(seed)
    view = checker.view(random_scene(checker.kinematics, rng, held))
    Q = random_configurations(checker.kinematics, 20, rng)
    for q, free in zip(Q, view.valid(Q, clearance), strict=True):
        contacts = view.contacts(q, clearance)
        assert bool(contacts) is not bool(free)
        assert [c.depth for c in contacts] == sorted((c.depth for c in contacts), reverse=True)
        assert all(c.depth > -clearance for c in contacts)
        assert all(np.linalg.norm(c.normal) == pytest.approx(1.0) for c in contacts)
        assert len({(c.part, c.link, c.object, c.other_link) for c in contacts}) == len(contacts)


@settings(max_examples=15, deadline=None)
@given(seed=seeds, robot=st.sampled_from(ROBOTS), held=st.booleans())
def test_more_clearance_never_frees_a_configuration(checkers, seed, robot, held):
    checker, rng = checkers[robot], np.random.default_rng(seed)
    view = checker.view(random_scene(checker.kinematics, rng, held))
    Q = random_configurations(checker.kinematics, 60, rng)
    valid = [view.valid(Q, clearance) for clearance in (-0.0005, 0.0, 0.003, 0.01, 0.05)]
    for closer, farther in pairwise(valid):
        assert (closer >= farther).all()


@pytest.mark.parametrize("robot", ROBOTS)
def test_outside_of_the_joint_limits_nothing_is_valid(checkers, robot):
    checker = checkers[robot]
    model = checker.kinematics.model
    view = checker.view(random_scene(checker.kinematics, np.random.default_rng(0), held=False))
    for joint in range(model.dof):
        for limit, outwards in ((model.low, -1e-3), (model.high, 1e-3)):
            q = model.home.copy()
            q[joint] = limit[joint] + outwards
            assert not view.valid(q[None])[0]


def test_no_configurations_get_no_verdicts(checker):
    view = checker.view(random_scene(checker.kinematics, np.random.default_rng(0), held=True))
    assert view.valid(np.empty((0, 7))).shape == (0,)


def test_large_batches_are_cut(checker):
    view = checker.view(random_scene(checker.kinematics, np.random.default_rng(3), held=False))
    Q = random_configurations(checker.kinematics, 2500, np.random.default_rng(1))
    whole = view.valid(Q)
    assert (whole == np.concatenate([view.valid(piece) for piece in np.array_split(Q, 9)])).all()


def test_configurations_are_counted(checker):
    view = checker.view(random_scene(checker.kinematics, np.random.default_rng(0), held=False))
    view.valid(random_configurations(checker.kinematics, 5, np.random.default_rng(0)))
    view.contacts(checker.kinematics.model.home)
    assert view.checks == 6


def test_two_worlds_do_not_notice_each_other(checker):
    kinematics = checker.kinematics
    rng = np.random.default_rng(11)
    Q = random_configurations(kinematics, 100, rng)
    one, another = (random_scene(kinematics, rng, held) for held in (False, True))
    with connect() as client:
        other = CollisionChecker(client, kinematics.model, kinematics)
        here, there = checker.view(one), other.view(another)
        interleaved = [(here.valid(Q[i : i + 10]), there.valid(Q[i : i + 10])) for i in range(0, 100, 10)]
    assert (np.concatenate([pair[0] for pair in interleaved]) == checker.view(one).valid(Q)).all()
    assert (np.concatenate([pair[1] for pair in interleaved]) == checker.view(another).valid(Q)).all()
