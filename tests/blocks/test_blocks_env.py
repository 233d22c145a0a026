"""The world of towers on the real simulator: what is possible, what comes of it, and why something is impossible."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from block_world import CUBE, after, carried_out, moved, pick, place, problem, refused, stack, tower
from scipy.spatial.transform import Rotation

from llm3.errors import InputError, InstanceError
from llm3.types import Entity, Failure, FailureKind, Motion, Pose
from llm3_bullet.poses import as_matrix
from llm3_bullet.tabletop.stance import stance

PROBLEM = problem(
    tower("red_block", "blue_block", at=(0.45, 0.15), yaw=0.3),
    tower("tan_block", at=(0.5, -0.15)),
    goal="blue_block on tan_block, red_block on blue_block",
)


@pytest.fixture(scope="module")
def env(make):
    return make(PROBLEM)


@pytest.fixture(scope="module")
def holding(env):
    return after(env, env.reset(), pick("blue_block"))


# ---- what a model reads ------------------------------------------------------------------------------------------


def test_the_task(env):
    assert env.task == (
        "A robot arm builds towers of blocks on a table. The arm stands at (0, 0) and faces the positive x axis; y "
        "points to its left and z points up. The table's surface is at z = 0. Lengths are in metres, angles in "
        "radians.\n"
        "The goal: on(blue_block, tan_block), on(red_block, blue_block), and the gripper is empty. Here on(a, b) means "
        "that block a rests on block b, or on the table, with its centre over what it rests on.\n"
        "A block on which another one stands cannot be picked, and nothing else can be stacked on it. A block is only "
        "placed on free space of the table. Keep the whole hand in mind: it is wider than a block, and low above the "
        "block that it holds, so a tower that is higher than this block must not be close beside it.\n"
        "The gripper takes a block from above between two fingers, on two opposite side faces no more than 0.072 m "
        "apart: the closer pair, or for a square block the pair along its own x direction (that of theta), and the "
        "other one only if the first is blocked. The fingers need about 0.030 m of free space beside these two faces, "
        "when they take a block and when they let go of it. Then the hand moves straight up."
    )


def test_the_state_tells_what_stands_on_what(env):
    assert env.describe(env.reset()) == (
        Entity("red_block", {"position": (0.45, 0.15, 0.025), "size": CUBE, "theta": 0.3, "stands on": "table"}),
        Entity("blue_block", {"position": (0.45, 0.15, 0.075), "size": CUBE, "theta": 0.3, "stands on": "red_block"}),
        Entity("tan_block", {"position": (0.5, -0.15, 0.025), "size": CUBE, "theta": 0.0, "stands on": "table"}),
    )


def test_a_held_block_is_in_the_gripper(env, holding):
    assert env.describe(holding)[1] == Entity("blue_block", {"size": CUBE, "position": "in the gripper"})


def test_what_may_be_asked_of_it(env):
    assert [schema.name for schema in env.schemas] == ["pick", "place", "stack"]
    assert env.objects == ("red_block", "blue_block", "tan_block")
    assert [joint.name for joint in env.joints] == [f"panda_joint{i}" for i in range(1, 8)]


# ---- what comes of it --------------------------------------------------------------------------------------------


def test_a_stacked_block_rests_on_the_middle_with_its_sides_along_those_below(env, holding):
    _, transition = carried_out(env, holding, stack("blue_block", "tan_block"))
    pose = transition.state.poses["blue_block"]
    assert pose.position == pytest.approx((0.5, -0.15, 0.075), abs=0.0015)
    yaw = stance(as_matrix(pose)[:3, :3], CUBE).yaw
    assert np.sin(2 * yaw) == pytest.approx(0.0, abs=0.02)  # a multiple of a quarter turn
    assert transition.notes == ()
    assert env.describe(transition.state)[1].properties["stands on"] == "tan_block"


def test_the_goal_is_reached_by_actions(env, holding):
    state = after(env, holding, stack("blue_block", "tan_block"), pick("red_block"), stack("red_block", "blue_block"))
    assert env.goal(state).achieved
    assert env.goal(holding).unmet == (
        "blue_block is still in the gripper, and not on tan_block",
        "red_block is not on blue_block",
    )


def test_taking_the_uppermost_block_leaves_those_below_where_they_are(env, holding):
    start = env.reset()
    assert {n: holding.poses[n] for n in ("red_block", "tan_block")} == {
        n: start.poses[n] for n in ("red_block", "tan_block")
    }


def test_a_tower_of_six_stands(make):
    names = [f"block_{number}" for number in range(6)]
    alone = [tower(name, at=(0.38 + 0.14 * (n // 3), -0.2 + 0.2 * (n % 3))) for n, name in enumerate(names)]
    env = make(problem(*alone, goal=", ".join(f"{a} on {b}" for b, a in pairwise(names))))
    state = env.reset()
    for below, name in pairwise(names):
        state = after(env, state, pick(name), stack(name, below))
    assert env.goal(state).achieved


def test_a_stack_that_topples_is_told(make):
    thin = problem(
        tower("post_block", at=(0.5, 0.0)),
        tower("red_block", at=(0.45, 0.2)),
        goal="red_block on post_block",
        sizes={"post_block": (0.006, 0.006, 0.08), "red_block": (0.07, 0.05, 0.05)},
    )
    env = make(thin)
    _, transition = carried_out(env, after(env, env.reset(), pick("red_block")), stack("red_block", "post_block"))
    assert [note.partition(" and is at")[0] for note in transition.notes] == [
        "post_block toppled",
        "red_block toppled",
    ]
    assert env.goal(transition.state).unmet == ("red_block is not on post_block",)


def test_a_motion_that_does_nothing_is_a_mistake_of_the_caller(env):
    with pytest.raises(ValueError) as error:
        env.apply(env.reset(), pick("blue_block"), Motion())
    assert str(error.value) == "the motion takes nothing and lets nothing go"


# ---- what is impossible ------------------------------------------------------------------------------------------


def precondition(sentence: str, *objects: str) -> Failure:
    return Failure(FailureKind.PRECONDITION, sentence, objects)


def test_a_block_on_which_another_one_stands_cannot_be_picked(env):
    assert refused(env, env.reset(), pick("red_block")) == precondition(
        "blue_block stands on red_block, so red_block cannot be picked.", "blue_block"
    )


def test_nothing_else_can_be_stacked_on_it(env):
    holding_tan = after(env, env.reset(), pick("tan_block"))
    assert refused(env, holding_tan, stack("tan_block", "red_block")) == precondition(
        "blue_block stands on red_block, so nothing else can be stacked on it.", "blue_block"
    )


def test_two_blocks_on_one_are_both_named(make):
    wide = problem(
        tower("wide_block", at=(0.5, 0.0)),
        tower("a", at=(0.5, 0.2)),
        tower("b", at=(0.5, -0.2)),
        goal="a on wide_block",
        sizes={"wide_block": (0.05, 0.2, 0.03)},
    )
    env = make(wide)
    state = moved(moved(env.reset(), "a", 0.5, 0.06, 0.055), "b", 0.5, -0.06, 0.055)
    assert refused(env, state, pick("wide_block")) == precondition(
        "a and b stand on wide_block, so wide_block cannot be picked.", "a", "b"
    )


@pytest.mark.parametrize(
    ("action", "sentence"),
    [
        (pick("tan_block"), "The gripper already holds blue_block, so it cannot pick tan_block."),
        (pick("blue_block"), "The gripper already holds blue_block, so it cannot pick blue_block."),
        (
            stack("tan_block", "red_block"),
            "The gripper holds blue_block, so it cannot stack tan_block: pick tan_block first.",
        ),
        (
            place("tan_block", 0.5, 0.0),
            "The gripper holds blue_block, so it cannot place tan_block: pick tan_block first.",
        ),
    ],
)
def test_the_hand_holds_one_block(env, holding, action, sentence):
    assert refused(env, holding, action) == precondition(sentence)


def test_a_block_cannot_be_stacked_on_itself(env, holding):
    assert refused(env, holding, stack("blue_block", "blue_block")) == precondition(
        "blue_block cannot be stacked on itself.", "blue_block"
    )


def test_nothing_can_be_stacked_on_a_block_that_leans(env, holding):
    leaning = tuple(Rotation.from_euler("x", 20, degrees=True).as_quat())
    state = replace(holding, poses={**holding.poses, "tan_block": Pose((0.5, -0.15, 0.03), leaning)})
    assert refused(env, state, stack("blue_block", "tan_block")) == precondition(
        "tan_block leans, so nothing can be stacked on it.", "tan_block"
    )
    assert env.describe(state)[2] == Entity(
        "tan_block",
        {"position": (0.5, -0.15, 0.03), "size": CUBE, "posture": "leaning", "stands on": "nothing squarely"},
    )


def test_what_is_not_held_cannot_be_stacked(env):
    assert refused(env, env.reset(), stack("tan_block", "blue_block")) == precondition(
        "The gripper is empty, so it cannot stack tan_block: pick tan_block first."
    )


def test_a_place_that_is_taken_collides_with_what_is_there(env, holding):
    failure = refused(env, holding, place("blue_block", 0.5, -0.15))
    assert failure.kind is FailureKind.GOAL_IN_COLLISION
    assert failure.objects == ("tan_block",)


def test_a_place_too_far_away_is_out_of_reach(env, holding):
    assert refused(env, holding, place("blue_block", 0.95, 0.3)).kind is FailureKind.UNREACHABLE


def test_fingers_need_room_between_neighbours(make):
    """Four blocks around one leave no side free."""
    gap = 0.06
    around = [(gap, 0.0), (-gap, 0.0), (0.0, gap), (0.0, -gap)]
    towers = [tower(f"side_{n}", at=(0.5 + dx, dy)) for n, (dx, dy) in enumerate(around)]
    env = make(problem(tower("red_block", at=(0.5, 0.0)), *towers, goal="red_block on side_0"))
    failure = refused(env, env.reset(), pick("red_block"))
    assert failure.kind is FailureKind.GOAL_IN_COLLISION
    assert set(failure.objects) <= {f"side_{n}" for n in range(4)}
    assert failure.contacts[0].part == "gripper"


def test_a_failed_action_changes_nothing(env, holding):
    before = env.describe(holding)
    for action in (stack("blue_block", "blue_block"), place("blue_block", 0.95, 0.3), pick("red_block")):
        refused(env, holding, action)
    assert env.describe(holding) == before
    assert env.reset() == env.reset()


def test_a_tower_under_the_arm_is_refused(make):
    with pytest.raises(InputError) as error:
        make(problem(tower("red_block", at=(0.0, 0.0)), goal="red_block on table"))
    assert str(error.value) == "the arm touches red_block where it starts: move it farther from the arm."


@pytest.mark.parametrize(
    ("instance", "sentence"),
    [
        (
            problem(
                tower("red_block", at=(0.5, 0.0)),
                tower("tan_slab", at=(0.5, -0.3)),
                goal="tan_slab on red_block",
                sizes={"tan_slab": (0.2, 0.2, 0.03)},
            ),
            "tan_slab is too wide for the gripper, which takes up to 0.072 m.",
        ),
        (
            problem(
                tower("tan_slab", "red_block", at=(0.5, 0.0)),
                tower("blue_block", at=(0.5, -0.3)),
                goal="tan_slab on blue_block",
                sizes={"red_block": (0.1, 0.1, 0.03)},
            ),
            "red_block is too wide for the gripper, which takes up to 0.072 m.",
        ),
        (
            problem(
                tower("red_block", at=(0.5, 0.0)), tower("blue_block", at=(0.9, 0.3)), goal="blue_block on red_block"
            ),
            "blue_block starts out of the arm's reach: move it closer to the arm.",
        ),
        (
            problem(
                tower("red_block", at=(0.5, 0.0)),
                tower("blue_block", at=(0.5, -0.2)),
                tower("tan_block", at=(0.5, 0.2)),
                goal="blue_block on red_block, tan_block on blue_block, red_block on table",
                sizes=dict.fromkeys(("red_block", "blue_block", "tan_block"), (0.05, 0.05, 0.4)),
            ),
            "the goal has tan_block 1.00 m above the table, and the arm puts nothing down higher than 0.93 m",
        ),
    ],
)
def test_a_problem_that_cannot_be_solved_is_refused_when_the_world_is_made(make, instance, sentence):
    with pytest.raises(InstanceError) as error:
        make(instance)
    assert str(error.value) == sentence


def test_what_stays_where_it_is_may_be_of_any_width_and_anywhere(make):
    sizes = {"tan_slab": (0.2, 0.2, 0.03)}
    make(
        problem(
            tower("tan_slab", at=(0.8, 0.5)),
            tower("red_block", at=(0.5, 0.0)),
            goal="red_block on tan_slab",
            sizes=sizes,
        )
    )
