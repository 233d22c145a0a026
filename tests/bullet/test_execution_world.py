"""A world with motors: what nobody holds falls, what moves is driven, and what is gripped is held by friction alone."""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.errors import UsageError
from llm3.types import Noise, Pose
from llm3_bullet.clients import connect
from llm3_bullet.execution import ExecutionSettings, MotorWorld, hand_of, scatter
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.poses import as_matrix, as_pose
from llm3_bullet.robots import iiwa, panda
from llm3_bullet.scene import Box
from llm3_bullet.tabletop.grasps import CUP_GAP
from llm3_bullet.tabletop.table import table

SIZE = (0.05, 0.05, 0.05)
STANDING = Box("cube", SIZE, Pose((0.5, 0.3, 0.025)))
USUAL = ExecutionSettings()
STEP = USUAL.boxes.time_step
GRAVITY = 9.81


@contextmanager
def world(*boxes, robot=panda, physics=USUAL):
    model = RobotModel(robot())
    with connect() as client:
        yield MotorWorld(client, model, (table(), *boxes), model.home, physics)


def in_hand(robot, gap=CUP_GAP, size=SIZE):
    """A box where the robot's gripper is at home, its upper face `gap` below a cup."""
    model = RobotModel(robot())
    tool = Kinematics(model).tool(model.home[None])[0]
    if model.description.suction:
        tool = tool @ as_matrix(Pose((0.0, 0.0, size[2] / 2 + gap)))
    return Box("cube", size, as_pose(tool))


def stand(box):
    """What the box stands on."""
    x, y, z = box.pose.position
    return Box("stand", (0.04, 0.04, 0.1), Pose((x, y, z - box.size[2] / 2 - 0.05)), fixed=True)


def lift(made, hand):
    """Raise the hand by its second joint."""
    home = made.configuration
    for part in np.linspace(0.0, 0.2, 240):
        made.drive(home - part * np.eye(len(home))[1])
        hand.look_after()


def wait(made, hand, seconds):
    for _ in range(round(seconds / STEP)):
        made.stay()
        hand.look_after()


@settings(max_examples=3)
@given(st.floats(0.02, 0.3))
def test_what_nobody_holds_falls_as_things_fall(height):
    with world(replace(STANDING, pose=Pose((0.5, 0.3, 0.025 + height)))) as made:
        seconds = 0.9 * np.sqrt(2 * height / GRAVITY)
        ticks = round(seconds / STEP)
        begun = made.box("cube")[2, 3]
        for _ in range(ticks):
            made.stay()
        fallen = begun - made.box("cube")[2, 3]
        assert fallen == pytest.approx(GRAVITY * (ticks * STEP) ** 2 / 2, abs=GRAVITY * STEP * ticks * STEP)


def test_what_stands_rests_where_it_is():
    with world(STANDING) as made:
        for _ in range(2400):
            made.stay()
        assert made.rests()
        assert np.linalg.norm(made.box("cube")[:3, 3] - STANDING.pose.position) < 1e-4


@pytest.mark.parametrize("robot", [panda, iiwa])
def test_the_arm_gets_there_by_its_motors_and_not_at_once(robot):
    with world(robot=robot) as made:
        begun = made.configuration
        target = begun + 0.1
        made.drive(target)
        assert np.abs(made.configuration - begun).min() < 0.05
        for _ in range(240):
            made.stay()
        assert np.abs(made.configuration - target).max() < 1e-4


def test_motors_are_only_as_strong_as_they_are():
    heavy = replace(USUAL.boxes, density=2e5)
    block = replace(in_hand(panda), size=(0.2, 0.2, 0.2))
    block = replace(block, pose=Pose((block.pose.position[0], 0.0, block.pose.position[2] + 0.5)))
    with world(block, physics=replace(USUAL, boxes=heavy)) as made:  # 1.6 t come down on the hand
        begun = made.configuration
        for _ in range(240):
            made.stay()
        assert np.abs(made.configuration - begun).max() > 0.1


@pytest.mark.parametrize("robot", [panda, iiwa])
def test_what_is_held_goes_with_the_hand_until_it_is_let_go(robot):
    box = in_hand(robot)
    with world(box, stand(box), robot=robot) as made:
        hand = hand_of(made)
        hand.take("cube", SIZE)
        wait(made, hand, 1.0)
        lift(made, hand)
        high = made.box("cube")[2, 3]
        assert hand.held() == "cube"
        assert high > box.pose.position[2] + 0.05
        wait(made, hand, 2.0)
        assert hand.held() == "cube"
        assert made.box("cube")[2, 3] == pytest.approx(high, abs=0.002)
        hand.let_go()
        wait(made, hand, 1.0)
        assert hand.held() is None
        assert made.box("cube")[2, 3] < high - 0.05


@pytest.mark.parametrize(
    "physics",
    [replace(USUAL, pad_friction=0.02, pad_spin=0.0), replace(USUAL, boxes=replace(USUAL.boxes, density=1e5))],
    ids=["too slippery", "too heavy"],
)
def test_what_is_too_slippery_or_too_heavy_slips_out_of_the_fingers(physics):
    box = in_hand(panda)
    with world(box, stand(box), physics=physics) as made:
        hand = hand_of(made)
        hand.take("cube", SIZE)
        wait(made, hand, 1.0)
        assert hand.held() == "cube"
        lift(made, hand)
        wait(made, hand, 1.0)
        assert hand.held() is None
        assert hand.missed("cube") == "the fingers closed on nothing"


def test_what_is_too_heavy_breaks_away_from_the_cup():
    strength = USUAL.suction * np.pi * RobotModel(iiwa()).description.suction.cup_radius ** 2
    for share, held in ((0.8, "cube"), (1.2, None)):
        density = share * strength / GRAVITY / np.prod(SIZE)
        physics = replace(USUAL, boxes=replace(USUAL.boxes, density=float(density)))
        with world(in_hand(iiwa), robot=iiwa, physics=physics) as made:
            hand = hand_of(made)
            hand.take("cube", SIZE)
            wait(made, hand, 0.5)
            assert hand.held() == held


def shifted(box, x=0.0, turn=0.0):
    """The box at another place below the hand."""
    shift = as_matrix(Pose((x, 0.0, 0.0), (0.0, np.sin(turn / 2), 0.0, np.cos(turn / 2))))
    return replace(box, pose=as_pose(as_matrix(box.pose) @ shift))


@pytest.mark.parametrize(
    ("box", "sentence"),
    [
        (in_hand(iiwa, gap=0.005), "the cup was 5.0 mm from its face"),
        (shifted(in_hand(iiwa), x=0.02), "the cup reached 9.0 mm beyond its face"),
        (shifted(in_hand(iiwa, size=(0.3, 0.3, 0.001)), turn=0.2), "the cup leaned by 11.5 degrees against its face"),
    ],
)
def test_a_cup_holds_only_what_its_whole_rim_is_at(box, sentence):
    with world(box, robot=iiwa) as made:
        hand = hand_of(made)
        hand.take("cube", box.size)
        assert hand.held() is None
        assert hand.missed("cube") == sentence


def test_fingers_that_are_stopped_on_their_way_do_not_grip_before_they_are_told():
    box = in_hand(panda)
    with world(box, stand(box)) as made:
        hand = hand_of(made)
        hand.open_to(0.05)  # just as wide as the box
        wait(made, hand, 1.0)
        hand.relax()
        wait(made, hand, 0.2)
        lift(made, hand)
        assert hand.held() is None
        assert np.linalg.norm(made.box("cube")[:3, 3] - box.pose.position) < 0.001


# ---- noise at the start --------------------------------------------------------------------------------------------

PAIR = (STANDING, Box("other", SIZE, Pose((0.5, 0.36, 0.025))))


def scattered(noise, seed=0, boxes=PAIR):
    with world(*boxes) as made:
        scatter(made, noise, np.random.default_rng(seed))
        return {name: made.box(name) for name in made.movable}


def test_without_noise_everything_starts_where_it_is_planned():
    for box in PAIR:
        assert np.allclose(scattered(Noise())[box.name], as_matrix(box.pose), atol=1e-12)


def test_noise_moves_along_the_table_and_turns_about_the_vertical_as_far_as_it_says():
    moves, turns = [], []
    with world(*PAIR) as made:
        for seed in range(60):
            for box in PAIR:
                made.put(box.name, box.pose.position, box.pose.orientation)
            scatter(made, Noise(0.002, 0.02), np.random.default_rng(seed))
            for box in PAIR:
                frame = made.box(box.name)
                assert frame[2, 3] == pytest.approx(0.025, abs=1e-9)
                assert frame[2, 2] == pytest.approx(1.0, abs=1e-9)
                moves += (frame[:2, 3] - box.pose.position[:2]).tolist()
                turns.append(np.arctan2(frame[1, 0], frame[0, 0]))
    assert np.std(moves) == pytest.approx(0.002, rel=0.3)
    assert np.std(turns) == pytest.approx(0.02, rel=0.3)
    assert abs(np.mean(moves)) < 0.001


def test_the_same_seed_draws_the_same_start_and_another_seed_another():
    first, again, other = (scattered(Noise(0.002, 0.02), seed)["cube"] for seed in (1, 1, 2))
    assert (first == again).all()
    assert not (first == other).all()


@settings(max_examples=5)
@given(st.integers(0, 2**32))
def test_nothing_starts_in_something_else(seed):
    with world(*PAIR) as made:
        scatter(made, Noise(0.02, 0.5), np.random.default_rng(seed))
        assert max(made.depth(name) for name in made.movable) <= 0.0005


def test_noise_that_leaves_no_room_is_refused():
    block = Box("block", (0.2, 0.2, 0.05), Pose((0.5, 0.0, 0.025)))
    walls = [
        Box(f"wall{n}", (0.3, 0.3, 0.1), Pose((0.5 + 0.2501 * dx, 0.2501 * dy, 0.05)), fixed=True)
        for n, (dx, dy) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1)))
    ]
    with pytest.raises(UsageError) as caught:
        scattered(Noise(0.05, 0.5), boxes=(block, *walls))
    assert str(caught.value) == (
        "a noise of 0.05 m and 0.5 rad leaves no room for block: it was drawn 100 times, each time into something else."
    )
