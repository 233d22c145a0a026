"""Each problem of the large settings comes with actions that solve it, of which nothing is in the problem."""

from __future__ import annotations

from contextlib import closing

import numpy as np
import pytest
from block_world import after, pick, place, problem, refused, tower
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.assembly import Problem
from llm3.interfaces import PlannerSettings
from llm3.jsonio import dumps
from llm3.records import PlanFile
from llm3.types import Failure, FailureKind
from llm3.witness import witness
from llm3_birrt.planner import BiRRT
from llm3_blocks.domain import Blocks
from llm3_blocks.env import BlocksEnv
from llm3_blocks.settings import LARGE, SETTINGS, SMALL
from llm3_blocks.solution import steps
from llm3_bullet.tabletop.table import TABLE
from llm3_bullet.workcell import Workcell

PANDA = {"robot": "panda"}
some = settings(max_examples=25)
large, seeds = st.sampled_from(LARGE), st.integers(0, 10**6)


@some
@given(large, seeds)
def test_what_solves_it_depends_on_setting_and_seed_alone_and_stands_nowhere_in_the_problem(setting, seed):
    domain = Blocks()
    actions = domain.witness(setting, seed)
    assert actions == domain.witness(setting, seed)
    text = dumps(domain.instance(setting, seed))
    for action in actions:
        if action.name == "place":
            assert f"[{action.params['x']},{action.params['y']}]" not in text


@some
@given(large, seeds)
def test_as_symbols_it_leads_from_the_start_to_the_goal(setting, seed):
    domain = Blocks()
    instance = domain.instance(setting, seed)
    below, held = dict(instance.start), ""
    for action in domain.witness(setting, seed):
        name = action.objects[0]
        if action.name == "pick":
            assert not held
            assert name not in below.values()
            held = name
            del below[name]
            continue
        target = TABLE if action.name == "place" else action.objects[1]
        assert name == held
        assert target == TABLE or (target in below and target not in below.values())
        below[name], held = target, ""
    assert {on.block: below[on.block] for on in instance.goal} == {on.block: on.below for on in instance.goal}


@some
@given(large, seeds)
def test_nothing_stands_higher_than_what_is_taken_from_a_tower_or_put_on_one(setting, seed):
    domain = Blocks()
    instance = domain.instance(setting, seed)
    sizes, below = instance.sizes, dict(instance.start)
    goal = {on.block for on in instance.goal}

    def top(name: str) -> float:
        return 0.0 if name == TABLE else top(below[name]) + sizes[name][2]

    for action in domain.witness(setting, seed):
        name = action.objects[0]
        if action.name == "pick":
            own = top(name)
            assert all(top(other) <= own + 1e-9 or below[name] == TABLE for other in goal)
        elif action.name == "stack":
            below[name] = action.objects[1]
            assert all(top(other) <= top(name) + 1e-9 for other in goal)
        else:
            below[name] = TABLE


def test_the_small_settings_have_none():
    assert SETTINGS == SMALL + LARGE
    assert all(Blocks().witness(setting, 0) is None for setting in SMALL)


def test_what_stands_above_what_is_moved_goes_to_the_table_too():
    instance = problem(
        tower("a", "b", "lid", at=(0.5, 0.0)), tower("c", at=(0.5, 0.1)), tower("d", at=(0.4, 0.3)), goal="c on b"
    )
    assert instance.close
    moves = [f"{move.name} {' '.join(move.objects)}" for move in steps(instance)]
    assert moves == ["pick lid", "place lid", "pick c", "place c", "pick c", "stack c b"]
    assert Blocks().skeleton(instance) == steps(instance)


# ---- in the real world -------------------------------------------------------------------------------------------


def proof(workcell: Workcell, setting: str, seed: int) -> PlanFile:
    """A sound plan; it is an error if the known solution is none."""
    instance = Blocks().instance(setting, seed)
    world = Problem(Blocks(), instance, PANDA, BlocksEnv(instance, workcell))
    return witness(world, setting, seed, BiRRT(PlannerSettings()))


@pytest.mark.parametrize(
    "setting", [pytest.param(s, marks=[] if s in ("blocks-8", "rebuild-6") else pytest.mark.slow) for s in LARGE]
)
def test_the_first_problem_of_each_setting_has_a_solution(workcell, setting):
    plan = proof(workcell, setting, 0)
    assert [step.action for step in plan.actions] == list(Blocks().witness(setting, 0))


@pytest.mark.slow
@pytest.mark.parametrize("setting", LARGE)
def test_so_have_others(workcell, setting):
    for seed in (1, 2, 1000):
        proof(workcell, setting, seed)


@pytest.mark.parametrize("setting", [name for name in LARGE if name.startswith("rebuild")])
def test_a_block_on_a_low_tower_cannot_be_taken_beside_a_higher_one(make, setting):
    """By the gripper: nothing stands on the block, and nothing touches it."""
    for seed in range(3):
        instance = Blocks().instance(setting, seed)
        env = make(instance)
        highest = max(instance.towers, key=lambda t: sum(instance.sizes[n][2] for n in t.blocks))
        tops = [t.blocks[-1] for t in instance.towers if t.blocks[0].endswith("plate") and t is not highest]
        rng = np.random.default_rng(0)
        answers = [env.prepare(env.reset(), pick(name), rng) for name in tops]
        failures = [answer for answer in answers if isinstance(answer, Failure)]
        assert failures
        for failure in failures:
            assert failure.kind is FailureKind.GOAL_IN_COLLISION
            assert {contact.part for contact in failure.contacts} <= {"gripper", "arm"}


@pytest.mark.parametrize("setting", [name for name in LARGE if name.startswith("blocks")])
def test_beside_a_higher_tower_there_is_room_for_a_cube_and_none_for_the_hand(make, setting):
    for seed in range(3):
        instance = Blocks().instance(setting, seed)
        env = make(instance)
        taken, *_ = Blocks().witness(setting, seed)
        name = taken.objects[0]
        tower = max((t for t in instance.towers if name not in t.blocks), key=lambda t: len(t.blocks))
        assert len(tower.blocks) >= 2
        (x, y), theta = tower.position, tower.yaw
        beside = place(name, x + 0.052 * np.cos(theta), y + 0.052 * np.sin(theta), theta)
        failure = refused(env, after(env, env.reset(), taken), beside)
        assert failure.kind is FailureKind.GOAL_IN_COLLISION
        assert {contact.part for contact in failure.contacts} <= {"gripper", "arm"}


def test_the_hand_s_size_is_told_where_it_matters(make):
    env = make(Blocks().instance("rebuild-10", 0))
    assert env.task.endswith(
        "Then the hand moves straight up. Above the fingers is the palm. Seen from above, it reaches 0.105 m to either "
        "side of the block's middle in the direction in which the fingers close, and 0.033 m across that. Its "
        "underside is 0.051 m above the block's middle (for a block lower than 0.048 m, 0.039 m and a quarter of the "
        "block's height), but at least 0.005 m above the block; the tips of the fingers are 0.048 m below that. What "
        "is higher than the underside must not be in the way of the palm, and what is higher than the tips not in "
        "that of the fingers."
    )
    with closing(Blocks().make(Blocks().instance("rebuild-10", 0), {"robot": "iiwa"})) as cup:
        assert cup.task.endswith("it moves straight up.")
