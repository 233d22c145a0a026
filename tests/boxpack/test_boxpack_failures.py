"""What the robot cannot do, and what it is told to blame."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from packing_world import BAR, BASKET, CUBE, POST, after, box, carried_out, moved, pick, place, problem, refused
from scipy.spatial.transform import Rotation

from llm3.errors import InputError, InstanceError, UsageError
from llm3.types import FailureKind, State
from llm3_boxpack.env import BoxpackEnv
from llm3_boxpack.instance import BasketSpec, BoxSpec
from llm3_bullet.robots.panda import panda
from llm3_bullet.touchdown import CUT_SHORT
from llm3_bullet.workcell import Workcell

RED, BLUE = box("red_box", 0.39, -0.2), box("blue_box", 0.39, 0.1)
TWO = problem(RED, BLUE)


@pytest.fixture(scope="module")
def env(make):
    return make(TWO)


@pytest.fixture(scope="module")
def holding(env) -> State:
    return after(env, env.reset(), pick("red_box"))


@pytest.fixture(scope="module")
def bar(make):
    return make(problem(box("green_box", 0.39, 0.1, BAR)))


def touched(failure) -> set[tuple[str, str]]:
    return {(contact.part, contact.object) for contact in failure.contacts}


def lying(state: State, name: str, euler: tuple[float, float, float], size, x=0.39, y=0.1) -> State:
    """The box on another face, or on an edge, at this place."""
    rotation = Rotation.from_euler("xyz", euler).as_matrix()
    return moved(state, name, x, y, float(np.abs(rotation)[2] @ size) / 2, rotation)


class TestPreconditions:
    def sentence(self, env, state: State, action) -> str:
        failure = refused(env, state, action)
        assert failure.kind is FailureKind.PRECONDITION
        return failure.detail

    def test_the_gripper_takes_one_box_at_a_time(self, env, holding):
        sentence = "The gripper already holds red_box, so it cannot pick blue_box."
        assert self.sentence(env, holding, pick("blue_box")) == sentence

    def test_a_held_box_is_not_picked_again(self, env, holding):
        sentence = "The gripper already holds red_box, so it cannot pick red_box."
        assert self.sentence(env, holding, pick("red_box")) == sentence

    def test_nothing_is_placed_with_an_empty_gripper(self, env):
        sentence = "The gripper is empty, so it cannot place red_box: pick red_box first."
        assert self.sentence(env, env.reset(), place("red_box", 0.6, 0.0)) == sentence

    def test_only_the_held_box_is_placed(self, env, holding):
        sentence = "The gripper holds red_box, so it cannot place blue_box: pick blue_box first."
        assert self.sentence(env, holding, place("blue_box", 0.6, 0.0)) == sentence

    def test_a_box_that_is_too_wide_is_not_taken(self, make):
        env = make(problem(box("red_box", 0.65, 0.0, (0.08, 0.09, 0.05))))  # it is where it belongs
        sentence = "red_box is too wide for the gripper, which takes up to 0.072 m."
        assert self.sentence(env, env.reset(), pick("red_box")) == sentence

    def test_a_leaning_box_is_not_taken(self, env):
        state = lying(env.reset(), "blue_box", (np.radians(30), 0.0, 0.0), CUBE)
        assert self.sentence(env, state, pick("blue_box")) == "blue_box leans, so it cannot be taken from above."


@pytest.mark.parametrize(("x", "y"), [(0.05, 0.0), (0.0, 0.0), (1.0, 1.0), (1.0, -1.0), (0.9, 0.0), (0.0, -1.0)])
def test_a_place_out_of_reach_is_unreachable_and_says_by_how_much(env, holding, x, y):
    failure = refused(env, holding, place("red_box", x, y))
    assert failure.kind is FailureKind.UNREACHABLE
    assert failure.contacts == ()
    assert set(failure.measures) == {"position_error", "rotation_error"}
    assert failure.measures["position_error"] > 0.02


def test_a_box_out_of_reach_is_unreachable(make):
    env = make(problem(box("red_box", 0.5, 0.0)))
    state = moved(env.reset(), "red_box", 1.2, 0.8, 0.035)
    assert refused(env, state, pick("red_box")).kind is FailureKind.UNREACHABLE


@pytest.mark.parametrize("theta", [0.0, 0.7, 1.57, 3.14, -1.57, -3.0])
@pytest.mark.parametrize(("x", "y"), [(0.5, 0.0), (0.65, -0.07), (0.65, 0.07), (0.3, 0.3)])
def test_every_angle_is_reached_within_the_arms_range(env, holding, x, y, theta):
    carried_out(env, holding, place("red_box", x, y, theta))


class TestCollisions:
    def blame(self, env, state: State, action) -> set[tuple[str, str]]:
        failure = refused(env, state, action)
        assert failure.kind is FailureKind.GOAL_IN_COLLISION
        assert set(failure.objects) == {contact.object for contact in failure.contacts}
        for contact in failure.contacts:
            assert contact.depth > 0
            assert np.linalg.norm(contact.normal) == pytest.approx(1.0)
        return touched(failure)

    def test_the_held_box_into_a_box(self, env, holding):
        assert ("held red_box", "blue_box") in self.blame(env, holding, place("red_box", 0.39, 0.1))
        assert self.blame(env, holding, place("red_box", 0.39, 0.035)) == {("held red_box", "blue_box")}

    def test_the_fingers_into_a_neighbour_that_is_too_close(self, make):
        env = make(problem(box("green_box", 0.4, 0.0, BAR), box("tan_box", 0.4, 0.055, POST)))  # 20 mm apart
        assert self.blame(env, env.reset(), pick("green_box")) == {("gripper", "tan_box")}
        carried_out(env, env.reset(), pick("tan_box"))  # across its other pair of faces

    def test_the_fingers_that_let_go_into_a_neighbour(self, env, holding):
        assert self.blame(env, holding, place("red_box", 0.39 + 0.077, 0.1)) == {("gripper", "blue_box")}

    def test_the_hand_against_a_wall(self, make):
        env = make(TWO, 0.1)
        state = after(env, env.reset(), pick("red_box"))
        assert self.blame(env, state, place("red_box", 0.72, 0.0)) == {("gripper", "basket_wall_back")}
        assert self.blame(env, state, place("red_box", 0.58, 0.0)) == {("gripper", "basket_wall_front")}
        assert ("held red_box", "basket_wall_back") in self.blame(env, state, place("red_box", 0.76, 0.0))
        after(env, state, place("red_box", 0.65, 0.0))

    def test_the_same_places_are_free_without_walls(self, env, holding):
        for x in (0.72, 0.58):
            carried_out(env, holding, place("red_box", x, 0.0))

    def test_of_several_ways_the_one_that_is_least_in_the_way_is_told(self, make):
        """One neighbour blocks one pair of a cube's faces, two others block the other pair from both sides."""
        neighbours = (
            box("left_box", 0.45, 0.165, POST),
            box("far_box", 0.515, 0.1, POST),
            box("near_box", 0.385, 0.1, POST),
        )
        env = make(problem(box("blue_box", 0.45, 0.1), *neighbours))
        assert self.blame(env, env.reset(), pick("blue_box")) == {("gripper", "left_box")}


class TestAnyFace:
    """A box that toppled is picked and placed as it lies."""

    @pytest.mark.parametrize(
        "euler",
        [(90, 0, 0), (-90, 0, 30), (0, 90, 0), (0, -90, 50), (180, 0, 0), (0, 180, 20), (0, 0, 180), (90, 90, 0)],
    )
    def test_it_is_picked_and_put_down_on_the_same_face(self, bar, euler):
        state = lying(bar.reset(), "green_box", tuple(np.radians(euler)), BAR)
        described = bar.describe(state)[1].properties
        end = after(bar, state, pick("green_box"), place("green_box", 0.65, 0.0, 0.5))
        properties = bar.describe(end)[1].properties
        assert properties["size"] == described["size"]
        assert properties["theta"] == pytest.approx(0.5, abs=0.002)
        assert properties["position"] == pytest.approx((0.65, 0.0, 0.01 + properties["size"][2] / 2), abs=0.0011)

    def test_a_tall_box_is_taken_where_the_palm_clears_its_top(self, make):
        env = make(problem(box("green_box", 0.39, 0.1, (0.05, 0.05, 0.2))))
        motion, _ = carried_out(env, env.reset(), pick("green_box"))
        assert motion.events[-1].grasp.position[2] > 0.05


class TestEdgeOfTheTray:
    """Physics says where the box comes to rest, and the note says so."""

    def result(self, env, holding, x: float):
        transition = carried_out(env, holding, place("red_box", x, 0.0))[1]
        return transition.notes, env.goal(transition.state).unmet[0]

    def test_a_box_whose_centre_is_over_the_tray_stays(self, env, holding):
        assert BASKET.area.corners[:, 0].max() == pytest.approx(0.76)
        assert self.result(env, holding, 0.745) == ((), "red_box reaches 20 mm out of the basket")

    def test_a_box_whose_centre_is_beyond_it_tips_over_its_edge(self, env, holding):
        (note,), unmet = self.result(env, holding, 0.775)
        assert note.startswith("red_box leans by ")
        assert note.endswith(" degrees and is at (0.782, 0.000) now")
        assert unmet == "red_box reaches 63 mm out of the basket"

    def test_a_box_that_only_just_leans_is_noted_too(self, env, holding):
        (note,), _ = self.result(env, holding, 0.79)
        assert note == "red_box leans by 9 degrees and is at (0.795, 0.000) now"

    def test_a_post_on_the_edge_topples(self, make):
        env = make(problem(box("tan_box", 0.39, 0.0, (0.02, 0.02, 0.15))))
        held = after(env, env.reset(), pick("tan_box"))
        (note,) = carried_out(env, held, place("tan_box", 0.763, 0.0))[1].notes
        assert note.startswith("tan_box toppled and is at (0.8")


@pytest.mark.parametrize("height", ["high", "-0.01", "0.21", "nan", "inf", ""])
def test_walls_of_a_height_that_cannot_be_are_refused(domain, height):
    with pytest.raises(UsageError) as error:
        domain.make(TWO, {"robot": "panda", "walls": height})
    assert str(error.value) == f"option 'walls' must be a height from 0 to 0.2 m or own, not {height!r}."


def test_a_box_inside_of_the_arm_is_refused_when_the_world_is_made(make):
    with pytest.raises(InputError) as error:
        make(problem(box("red_box", 0.0, 0.0)))
    assert str(error.value) == "the arm touches red_box where it starts: move it farther from the arm."


@pytest.mark.parametrize(
    ("instance", "sentence"),
    [
        (
            problem(box("red_box", 0.4, 0.0, (0.2, 0.2, 0.07))),
            "red_box is too wide for the gripper, which takes up to 0.072 m.",
        ),
        (problem(box("red_box", 1.2, 0.8)), "red_box starts out of the arm's reach: move it closer to the arm."),
        (
            problem(box("red_box", 0.5, 0.0), basket=BasketSpec((0.1, 0.0), (0.2, 0.2))),
            "the arm stands on basket: move it farther from the arm.",
        ),
        (
            problem(box("red_box", 0.5, 0.0), basket=BasketSpec((1.3, 0.0), (0.2, 0.2))),
            "basket is out of the arm's reach: move it closer to the arm.",
        ),
        (problem(box("red_box", 0.502, 0.0)), "basket_wall_front and red_box start in one another"),
    ],
)
def test_a_problem_that_cannot_be_solved_is_refused_when_the_world_is_made(make, instance, sentence):
    with pytest.raises(InstanceError) as error:
        make(instance, 0.05)
    assert str(error.value) == sentence


@pytest.mark.parametrize(
    ("home", "sentence"),
    [
        (
            (0.0, -0.2, 0.3, -2.5, -0.3, 0.2, 0.1),
            "links of the arm touch each other where it starts: panda_hand and panda_link5. Change the robot's home, "
            "or name pairs that always touch in its may_touch.",
        ),
        (
            (-0.1, 0.4, -0.2, -2.6, 0.1, 2.3, 1.0),
            "the arm touches what stands around it where it starts: panda_rightfinger and table. Change the robot's "
            "home or base, or name links that it stands on in its mounted_links.",
        ),
    ],
)
def test_an_arm_that_does_not_start_free_is_refused_with_what_to_change(home, sentence):
    cell = Workcell(replace(panda(), home=home))
    with pytest.raises(InputError) as error:
        BoxpackEnv(problem(box("red_box", 0.5, 0.3)), cell)
    assert str(error.value) == sentence
    cell.close()


def test_a_problem_that_is_refused_leaves_no_simulator_behind(domain, monkeypatch):
    closed = []
    monkeypatch.setattr(Workcell, "close", lambda cell, close=Workcell.close: (closed.append(cell), close(cell)))
    with pytest.raises(InputError):
        domain.make(problem(box("red_box", 0.0, 0.0)), {"robot": "panda", "walls": "0"})
    assert len(closed) == 1


def test_a_grasp_that_leaves_no_clearance_to_go_on_from_is_no_goal(make):
    """A bar right beside a tall box: the hand could come down, but the next path could not begin up there."""
    tall = BoxSpec("blue_box", (0.07, 0.07, 0.25), (0.39, 0.1))
    low = BoxSpec("green_box", BAR, (0.39 - 0.035 - 0.0525 - 0.003, 0.1))
    env = make(problem(tall, low))
    failure = refused(env, env.reset(), pick("green_box"))
    assert failure.kind is FailureKind.GOAL_IN_COLLISION
    assert failure.objects == ("blue_box",)
    assert len(failure.configuration) == 7


def test_a_spot_that_can_be_reached_but_not_from_above_is_told_apart(make):
    """A box as tall as the arm is long: it can be put down, but the hand cannot rise above it."""
    env = make(problem(BoxSpec("red_box", (0.04, 0.04, 0.5), (0.65, 0.3))))
    failure = refused(env, env.reset(), pick("red_box"))
    assert failure.kind is FailureKind.UNREACHABLE
    assert failure.detail == CUT_SHORT
    assert failure.measures == {}
