"""What the world does: it carries and pushes rigidly, refuses with a reason, and depends on the state alone."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from plane_world import DOMAIN, after, asked, box, disc, done, moved, pick, place, problem, push, refused, wall, world

from llm3.errors import InputError, UsageError
from llm3.jsonio import dumps
from llm3.types import EventKind, Failure, FailureKind, MotionProblem, NoMotion, Pose
from llm3_tabletop2d.env import TabletopEnv
from llm3_tabletop2d.ways import CLEARANCE
from llm3_words.sentences import sentence_of

BLOCKED, CUT_OFF = FailureKind.GOAL_IN_COLLISION, FailureKind.UNREACHABLE
spots = st.tuples(st.floats(0.2, 1.0), st.floats(0.2, 0.6))
few = settings(max_examples=25)


# ---- laws ------------------------------------------------------------------------------------------------------------


@few
@given(st.floats(-3.14, 3.14), spots, st.floats(0, pi))
def test_what_is_carried_moves_with_the_robot_and_does_not_turn(angle, spot, theta):
    env = world(box("red_box", 0.5, 0.4, theta=theta))
    start = env.reset()
    picked, placed = done(env, start, pick("red_box", angle), place("red_box", *spot))
    held = picked.state.held
    assert picked.state.poses == {}
    (attach,) = (event for event in picked.motion.events if event.kind is EventKind.ATTACH)
    assert held.grasp == attach.grasp
    carried = np.array(placed.motion.segments[-1].waypoints[0]) + held.grasp.position[:2]
    pose = placed.state.poses["red_box"]
    assert np.allclose(pose.position[:2], carried, atol=1e-9)
    assert np.allclose(pose.position[:2], spot, atol=1e-4)
    assert pose.orientation == start.poses["red_box"].orientation
    assert placed.state.held is None


@few
@given(spots, st.floats(0, pi))
def test_what_is_pushed_moves_straight_to_where_it_is_to_go_and_does_not_turn(spot, theta):
    env = world(box("red_box", 0.5, 0.4, (0.16, 0.1), theta))
    answer = asked(env, env.reset(), push("red_box", *spot))
    if isinstance(answer, NoMotion):
        assert np.allclose(spot, (0.5, 0.4), atol=1e-4)
        return
    (step,) = done(env, env.reset(), push("red_box", *spot))
    segment = next(s for s in step.motion.segments if s.label == "push")
    way = np.subtract(segment.waypoints[-1], segment.waypoints[0])
    pose = step.state.poses["red_box"]
    assert np.allclose(np.array(pose.position[:2]) - (0.5, 0.4), way, atol=1e-9)
    assert np.allclose(pose.position[:2], spot, atol=1e-4)
    assert pose.orientation == env.reset().poses["red_box"].orientation
    behind = np.array((0.5, 0.4)) - segment.waypoints[0]
    assert behind @ way > 0


@pytest.mark.parametrize("radius", [0.0, 0.03, 0.06])
def test_every_place_of_a_motion_is_free_between_the_samples_too(radius):
    walls = (wall("post", 0.6, 0.55, 0.04, 0.5),)
    env = world(disc("red_disc", 0.4, 0.6), box("blue_box", 0.8, 0.6, theta=0.7), walls=walls, radius=radius)
    for action in (pick("red_disc", -1.5), push("red_disc", 0.4, 0.3), pick("blue_box", 0.3)):
        query = asked(env, env.reset(), action)
        assert isinstance(query, MotionProblem)
        (step,) = done(env, env.reset(), action)
        for a, b in zip(step.motion.segments[0].waypoints, step.motion.segments[0].waypoints[1:], strict=False):
            fine = np.linspace(a, b, 2000)
            depths = [max((c.depth for c in query.explain(q)), default=-1.0) for q in fine[~query.valid(fine)]]
            assert max(depths, default=-1.0) < 0


def test_answers_depend_on_the_arguments_alone():
    env, fresh = (world(disc("red_disc", 0.5, 0.4), box("blue_box", 0.8, 0.2)) for _ in range(2))
    held = after(fresh, pick("red_disc"))
    asked(env, held, place("red_disc", 0.9, 0.4))
    env.describe(held)
    env.goal(held)
    for state, action in ((env.reset(), pick("red_disc", 1.0)), (held, place("red_disc", 0.3, 0.6))):
        before = dumps(state)
        one, two = asked(env, state, action), asked(fresh, state, action)
        assert one.goals[0] == two.goals[0]
        assert dumps(state) == before
    assert env.reset() == fresh.reset()


def test_explain_and_valid_agree():
    env = world(disc("red_disc", 0.5, 0.4), walls=(wall("post", 0.7, 0.4, 0.04, 0.2),))
    query = asked(env, after(env, pick("red_disc")), place("red_disc", 0.9, 0.4))
    points = np.random.default_rng(0).uniform((0, 0), (1.2, 0.8), (300, 2))
    for point, free in zip(points, query.valid(points), strict=True):
        contacts = query.explain(point)
        assert bool(contacts) != free
        assert [c.depth for c in contacts] == sorted((c.depth for c in contacts), reverse=True)
        assert all(c.depth > -CLEARANCE and c.part in ("robot", "held red_disc") for c in contacts)


@given(st.floats(0.85, 1.25), st.floats(0.1, 0.7))
def test_the_goal_is_reached_where_nothing_is_unmet(x, y):
    env = world(disc("red_disc", 0.5, 0.4))
    status = env.goal(moved(env.reset(), "red_disc", x, y))
    inside = max(abs(round(x, 4) - 1.05) - 0.1, abs(round(y, 4) - 0.4) - 0.2) + 0.04 <= 0.001 + 1e-9
    assert status.achieved == (not status.unmet)
    assert status.achieved == inside


# ---- what is missing of the goal -------------------------------------------------------------------------------------


def test_what_is_missing_is_told():
    env = world(disc("red_disc", 0.5, 0.4))
    assert env.goal(env.reset()).unmet == ("red_disc is not in tray",)
    assert env.goal(moved(env.reset(), "red_disc", 0.978, 0.4)).unmet == ("red_disc reaches 12 mm out of tray",)
    assert env.goal(after(env, pick("red_disc"))).unmet == ("red_disc is still held",)
    assert env.goal(after(env, pick("red_disc"), place("red_disc", 1.05, 0.4))).achieved


# ---- refusals --------------------------------------------------------------------------------------------------------


def test_what_is_not_possible_in_a_state():
    env = world(disc("red_disc", 0.5, 0.4), box("blue_box", 0.8, 0.2), box("crate", 0.8, 0.6, (0.2, 0.16)))
    start, held = env.reset(), after(env, pick("blue_box"))
    cases = [
        (held, pick("red_disc"), "The robot already holds blue_box, so it cannot pick red_disc."),
        (
            start,
            place("red_disc", 1, 0.4),
            "The robot holds nothing, so it cannot place red_disc: pick red_disc first.",
        ),
        (
            held,
            place("red_disc", 1, 0.4),
            "The robot holds blue_box, so it cannot place red_disc: pick red_disc first.",
        ),
        (held, push("red_disc", 1, 0.4), "The robot holds blue_box, so it cannot push red_disc: place blue_box first."),
        (
            start,
            pick("crate"),
            "crate is too large to be carried: its longest side is 0.2 m, and the robot carries up to 0.15 m. It can "
            "be pushed.",
        ),
    ]
    for state, action, sentence in cases:
        assert refused(env, state, action) == Failure(FailureKind.PRECONDITION, sentence)


def test_what_stands_where_the_robot_would_have_to_stand_is_named():
    env = world(disc("red_disc", 0.5, 0.4), box("blue_box", 0.41, 0.4))
    failure = refused(env, env.reset(), pick("red_disc"))
    assert (failure.kind, failure.objects, failure.detail) == (BLOCKED, ("blue_box",), "")
    assert [(c.part, c.object) for c in failure.contacts] == [("robot", "blue_box")]
    assert failure.contacts[0].depth > 0
    assert isinstance(asked(env, env.reset(), pick("red_disc", 0.0)), MotionProblem)


def test_what_stands_where_the_held_object_would_have_to_be_is_named():
    env = world(disc("red_disc", 0.5, 0.4), box("blue_box", 0.8, 0.4))
    failure = refused(env, after(env, pick("red_disc")), place("red_disc", 0.75, 0.4))
    assert (failure.kind, failure.objects) == (BLOCKED, ("blue_box",))
    assert [(c.part, c.object) for c in failure.contacts] == [("held red_disc", "blue_box")]
    assert sentence_of(failure) == (
        "The goal configuration is in collision with blue_box (touched by the held red_disc)."
    )


def test_what_stands_in_the_way_of_a_push_is_named_and_how_far_it_gets():
    env = world(disc("red_disc", 0.4, 0.4), box("blue_box", 0.7, 0.4))
    failure = refused(env, env.reset(), push("red_disc", 0.9, 0.4))
    assert (failure.kind, failure.objects) == (BLOCKED, ("blue_box",))
    assert failure.detail == "The push is stopped after 0.220 m."
    assert [(c.part, c.object) for c in failure.contacts] == [("pushed red_disc", "blue_box")]


def test_a_wall_is_named_as_well():
    env = world(disc("red_disc", 0.4, 0.4), walls=(wall("post", 0.8, 0.4, 0.04, 0.2),))
    assert refused(env, env.reset(), push("red_disc", 0.9, 0.4)).objects == ("post",)
    assert refused(env, after(env, pick("red_disc")), place("red_disc", 0.6, 0.765)).objects == ("outer_wall",)


def test_there_is_nothing_to_stand_on_outside_of_the_room():
    env = world(disc("red_disc", 0.5, 0.05))
    failure = refused(env, env.reset(), pick("red_disc", -pi / 2 + 0.0003))
    assert failure.kind is CUT_OFF
    assert failure.detail == "The robot would have to stand outside of the room, at (0.500, -0.032)."


def test_a_way_that_is_too_narrow_is_proven_and_what_blocks_it_is_named():
    door = (wall("lower", 0.6, 0.15, 0.04, 0.3), wall("upper", 0.6, 0.65, 0.04, 0.3))
    env = world(disc("red_disc", 0.3, 0.4), box("grey_box", 0.53, 0.4, (0.08, 0.15)), walls=door)
    failure = refused(env, after(env, pick("red_disc")), place("red_disc", 1.05, 0.4))
    assert (failure.kind, failure.objects) == (CUT_OFF, ("grey_box",))
    assert failure.detail == (
        "It is cut off: no gap on the way there is wide enough for the robot and red_disc. grey_box is in the way."
    )
    narrow = (wall("lower", 0.6, 0.175, 0.04, 0.35), wall("upper", 0.6, 0.625, 0.04, 0.35))
    env = world(disc("red_disc", 0.3, 0.4), disc("blue_disc", 0.9, 0.4), walls=narrow)
    assert isinstance(asked(env, env.reset(), pick("blue_disc")), MotionProblem)
    failure = refused(env, after(env, pick("red_disc", 1.57)), place("red_disc", 1.05, 0.4))
    assert failure.detail == "It is cut off: no gap on the way there is wide enough for the robot and red_disc."
    assert failure.objects == ()


def test_a_push_to_where_it_is_needs_no_motion():
    env = world(disc("red_disc", 0.5, 0.4))
    (step,) = done(env, env.reset(), push("red_disc", 0.50001, 0.4))
    assert step.state == env.reset()
    assert not step.motion.segments


# ---- the start -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("objects", "sentence"),
    [
        (
            (disc("red_disc", 0.5, 0.4), disc("blue_disc", 0.55, 0.4)),
            "blue_disc and red_disc touch each other: leave at least 1 mm between them.",
        ),
        (
            (disc("red_disc", 0.5, 0.4), disc("blue_disc", 0.5805, 0.4)),
            "blue_disc and red_disc start 0.5 mm apart: leave at least 1 mm between them.",
        ),
        ((disc("red_disc", 0.02, 0.7),), "red_disc and outer_wall touch each other: leave at least 1 mm between them."),
        (
            (disc("red_disc", 0.172, 0.4),),
            "the robot and red_disc start 2.0 mm apart: leave at least 5 mm between them.",
        ),
    ],
)
def test_a_start_that_makes_no_sense_is_refused(objects, sentence):
    with pytest.raises(InputError) as error:
        TabletopEnv(problem(*objects), 0.03)
    assert str(error.value) == sentence


@pytest.mark.parametrize("text", ["-0.1", "0.2", "wide", "nan"])
def test_a_radius_that_makes_no_sense_is_refused(text):
    with pytest.raises(UsageError) as error:
        DOMAIN.make(problem(disc("red_disc", 0.5, 0.4)), {"robot_radius": text})
    assert str(error.value) == f"option 'robot_radius' must be a length from 0 to 0.1 m, not {text!r}."


# ---- words -----------------------------------------------------------------------------------------------------------


def test_the_state_is_told_to_the_millimetre_and_changes_with_the_world():
    env = world(disc("red_disc", 0.50004, 0.4), box("blue_box", 0.8, 0.2, theta=0.5))
    told = {entity.name: dict(entity.properties) for entity in env.describe(env.reset())}
    assert told == {
        "room": {"x range": (0.0, 1.2), "y range": (0.0, 0.8)},
        "tray": {"x range": (0.95, 1.15), "y range": (0.2, 0.6)},
        "robot": {"position": (0.1, 0.4), "holds": "nothing"},
        "red_disc": {"shape": "disc", "diameter": 0.08, "position": (0.5, 0.4), "belongs in": "tray"},
        "blue_box": {"shape": "box", "size": (0.08, 0.06), "position": (0.8, 0.2), "theta": 0.5},
    }
    held = {entity.name: entity.properties for entity in env.describe(after(env, pick("red_disc", 0.0)))}
    assert held["robot"]["holds"] == "red_disc"
    assert np.allclose(np.subtract(held["red_disc"]["position"], held["robot"]["position"]), (-0.071, 0), atol=1e-9)


def test_the_robot_is_told_as_it_is():
    instance = problem(disc("red_disc", 0.5, 0.4))
    assert "The robot is a disc of radius 0.05 m" in TabletopEnv(instance, 0.05).task
    assert "The robot is a point" in TabletopEnv(instance, 0.0).task


def test_it_is_drawn_as_it_stands():
    instance = problem(
        disc("red_disc", 0.5, 0.4), box("blue_box", 0.8, 0.2, theta=pi / 2), walls=(wall("post", 0.7, 0.7, 0.1, 0.1),)
    )
    env = TabletopEnv(instance, 0.03)
    options = {"robot_radius": "0.03"}
    shapes = {shape.name: shape for shape in DOMAIN.top_view(instance, options, env.reset())}
    assert [name for name, shape in shapes.items() if shape.robot] == ["robot"]
    assert np.allclose(np.linalg.norm(np.subtract(shapes["robot"].corners, instance.robot), axis=1), 0.03)
    assert {name for name, shape in shapes.items() if shape.fixed} == {"room", "tray", "post"}
    corners = np.array(shapes["blue_box"].corners)
    assert np.allclose(np.ptp(corners, axis=0), (0.06, 0.08), atol=1e-4)
    assert np.allclose(np.linalg.norm(np.subtract(shapes["red_disc"].corners, (0.5, 0.4)), axis=1), 0.04)
    held = {shape.name: shape for shape in DOMAIN.top_view(instance, options, after(env, pick("red_disc")))}
    between = np.subtract(np.mean(held["red_disc"].corners, axis=0), np.mean(held["robot"].corners, axis=0))
    assert np.linalg.norm(between) == pytest.approx(0.07, abs=2e-3)  # it is in the robot's hand, beside it


def test_apply_tells_a_motion_that_takes_hold_of_nothing():
    env = world(disc("red_disc", 0.5, 0.4))
    (step,) = done(env, env.reset(), pick("red_disc"))
    with pytest.raises(ValueError, match="nobody holds red_disc, so it cannot be moved"):
        env.apply(env.reset(), place("red_disc", 1, 0.4), type(step.motion)(step.motion.segments[:1]))
    assert env.reset().poses["red_disc"] == Pose((0.5, 0.4, 0.0))
