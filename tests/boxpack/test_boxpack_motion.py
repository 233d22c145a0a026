"""The motion of one action: its pieces, what happens between them, and where everything is afterwards."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from packing_world import BAR, POST, box, carried_out, pick, place, prepared, problem

from llm3.types import EventKind, Motion, State
from llm3.types.state import LENGTH_DECIMALS
from llm3_boxpack.layout import furniture
from llm3_bullet.poses import as_matrix
from llm3_bullet.scene import Box
from llm3_bullet.tabletop.manipulation import DROP
from llm3_bullet.tabletop.tabletop import CLEARANCE
from llm3_bullet.touchdown import TouchdownSettings

INSTANCE = problem(box("red_box", 0.39, -0.2), box("green_box", 0.39, 0.05, BAR), box("tan_box", 0.39, 0.3, POST))
ACTIONS = (
    pick("green_box"),
    place("green_box", 0.6, -0.05, 0.3),
    pick("red_box"),
    place("red_box", 0.7, 0.04, -1.0),
    pick("tan_box"),
    place("tan_box", 0.5, 0.2),
    pick("red_box"),
    place("red_box", 0.39, -0.3, 3.0),
)
PLACES = (1, 3, 5, 7)


@pytest.fixture(scope="module")
def env(make):
    return make(INSTANCE)


@pytest.fixture(scope="module")
def steps(env) -> list[tuple[State, Motion, State]]:
    """The state before, the motion and the state after each action."""
    done = []
    state = env.reset()
    for action in ACTIONS:
        motion, transition = carried_out(env, state, action)
        assert transition.notes == ()
        done.append((state, motion, transition.state))
        state = transition.state
    return done


def test_an_action_is_a_transit_and_the_way_down_and_up_again(steps):
    ways = {"pick": ["transit", "approach", "lift"], "place": ["transit", "descend", "retreat"]}
    for action, (_, motion, _) in zip(ACTIONS, steps, strict=True):
        assert [segment.label for segment in motion.segments] == ways[action.name]


def test_the_segments_join_and_the_arm_ends_where_the_motion_ends(steps):
    for before, motion, after in steps:
        assert motion.segments[0].waypoints[0] == before.configuration
        for one, two in pairwise(motion.segments):
            assert one.waypoints[-1] == two.waypoints[0]
        assert motion.end == after.configuration


def test_a_pick_opens_the_gripper_and_closes_it_on_the_box(steps):
    for number, width in ((0, 0.035), (2, 0.07), (4, 0.035)):
        _, motion, after = steps[number]
        transit, approach, retreat = motion.segments
        assert [(e.kind, e.opening) for e in transit.events] == [(EventKind.GRIPPER, 0.08)]
        assert [(e.kind, e.opening) for e in approach.events] == [(EventKind.GRIPPER, pytest.approx(width + 0.008))]
        close, attach = retreat.events
        assert (close.kind, close.opening) == (EventKind.GRIPPER, width)
        assert (attach.kind, attach.object) == (EventKind.ATTACH, ACTIONS[number].objects[0])
        assert after.held is not None
        assert (after.held.object, after.held.grasp) == (attach.object, attach.grasp)
        assert attach.object not in after.poses


def test_a_place_lets_go_and_opens_the_gripper_a_little(steps):
    for number, width in ((1, 0.035), (3, 0.07), (5, 0.035)):
        _, motion, after = steps[number]
        transit, approach, retreat = motion.segments
        assert transit.events == approach.events == ()
        detach, open_ = retreat.events
        assert (detach.kind, detach.object) == (EventKind.DETACH, ACTIONS[number].objects[0])
        assert (open_.kind, open_.opening) == (EventKind.GRIPPER, pytest.approx(width + 0.008))
        assert after.held is None
        assert set(after.poses) == {b.name for b in INSTANCE.boxes}


def test_the_hand_comes_straight_down_and_goes_straight_up(workcell, steps):
    for _, motion, _ in steps:
        _, approach, retreat = motion.segments
        assert approach.waypoints == retreat.waypoints[::-1]
        tools = workcell.kinematics.tool(np.array(retreat.waypoints))
        assert np.ptp(tools[:, :2, 3], axis=0) == pytest.approx((0.0, 0.0), abs=0.0007)
        assert np.diff(tools[:, 2, 3]) == pytest.approx(0.01, abs=0.001)
        assert tools[:, :3, 2] == pytest.approx(np.tile((0.0, 0.0, -1.0), (len(tools), 1)), abs=0.005)


def test_the_boxs_pose_does_not_change_when_it_is_grasped(workcell, steps):
    for number in (0, 2, 4, 6):
        before, motion, after = steps[number]
        tool = workcell.kinematics.tool(np.array(motion.segments[-1].waypoints[:1]))[0]
        in_hand = tool @ as_matrix(after.held.grasp)
        assert in_hand == pytest.approx(as_matrix(before.poses[after.held.object]), abs=0.002)


def test_a_place_lets_go_of_the_box_2_mm_above_what_it_will_stand_on(workcell, steps):
    assert DROP == 0.002
    for number in PLACES:
        before, motion, after = steps[number]
        tool = workcell.kinematics.tool(np.array(motion.segments[-1].waypoints[:1]))[0]
        released = (tool @ as_matrix(before.held.grasp))[:3, 3]
        rests = after.poses[before.held.object].position
        assert released[2] - rests[2] == pytest.approx(DROP, abs=0.0006)
        assert rests[:2] == pytest.approx((ACTIONS[number].params["x"], ACTIONS[number].params["y"]), abs=0.0015)


def test_after_a_place_everything_is_at_rest(workcell, steps):
    sizes = {b.name: b.size for b in INSTANCE.boxes}
    for number in PLACES:
        poses = steps[number][2].poses
        boxes = [Box(name, sizes[name], pose) for name, pose in poses.items()]
        again = workcell.settler.settle((*furniture(INSTANCE.basket), *boxes))
        for name, pose in poses.items():
            change = np.subtract(again[name].position, pose.position)
            # Both are on the grid of states, so a change of less than 0.1 mm may show as one step of it.
            assert np.abs(change).max() <= 1.01 * 10**-LENGTH_DECIMALS


def test_what_is_not_touched_stays_where_it_is(steps):
    for before, _, after in steps:
        for name in set(before.poses) & set(after.poses):
            assert after.poses[name].position == pytest.approx(before.poses[name].position, abs=0.0003)


def test_the_transit_keeps_its_clearance_where_it_is_sampled_and_touches_nothing_in_between(workcell, env, steps):
    for number, (before, motion, _) in enumerate(steps):
        query = prepared(env, before, ACTIONS[number])
        waypoints = np.array(motion.segments[0].waypoints)
        view = workcell.checker.view(env.scene(before))
        assert view.valid(waypoints, CLEARANCE).all()
        for a, b in pairwise(waypoints):
            count = 4 * int(np.ceil((np.abs(b - a) / query.resolution).sum())) + 1
            assert view.valid(a + np.linspace(0.0, 1.0, count)[:, None] * (b - a)).all()


def test_the_goals_are_a_few_and_each_is_above_the_spot(workcell, env, steps):
    for number, (before, _, _) in enumerate(steps):
        query = prepared(env, before, ACTIONS[number])
        assert 1 <= len(query.goals) <= TouchdownSettings().enough
        for goal in query.goals:
            assert goal.configuration == goal.then[0].waypoints[0] == goal.then[-1].waypoints[-1]
            low, high = goal.then[0].waypoints[-1], goal.configuration
            heights = workcell.kinematics.tool(np.array([low, high]))[:, 2, 3]
            assert heights[1] - heights[0] == pytest.approx(TouchdownSettings().height, abs=0.001)
