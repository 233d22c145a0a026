"""Looking along a motion: nothing hides between two looks, and nothing moves farther than is said."""

from __future__ import annotations

import numpy as np
import pytest
from random_worlds import random_scene

from llm3.types import Pose
from llm3_bullet.clients import connect
from llm3_bullet.robot import RobotDescription, SuctionGripper
from llm3_bullet.robots import iiwa
from llm3_bullet.scene import Box
from llm3_bullet.verification import PlainWorld
from llm3_bullet.verification.boxes import CORNERS, matrix, surface_distance
from llm3_bullet.verification.look import HORIZON
from llm3_bullet.verification.sweep import CONTACT, STEP, cubic, line, sweep

ROBOTS = ("panda", "toy", "iiwa")
DENSE = 300


@pytest.fixture(scope="module")
def robots(descriptions):
    return {**descriptions, "iiwa": iiwa()}


def random_world(client, robot, checkers, rng):
    """The robot in a random configuration among random boxes, in half of the cases with one in its hand."""
    kinematics = checkers["panda"].kinematics  # it only says about where the boxes stand
    scene = random_scene(kinematics, rng, bool(rng.random() < 0.5))
    cargo = [Box("cargo", scene.held.size, Pose((0.0, 0.0, 0.0)))] if scene.held else []
    world = PlainWorld(client, robot, scene.boxes, cargo)
    low, high = world.arm.limits.T
    q = np.append(rng.uniform(low, high), rng.uniform(0.0, 0.08))
    world.move(q)
    if scene.held:
        world.attach("cargo", scene.held.grasp)
    return world, q


def random_piece(world, q, rng):
    """A line or a cubic from q, of some random size."""
    low, high = world.arm.limits.T
    step = rng.normal(size=len(low)) * rng.choice([0.01, 0.05, 0.3])
    end = np.append(np.clip(q[:-1] + step, low, high), rng.uniform(0.0, 0.08))
    if rng.random() < 0.5:
        return line(q, end)
    return cubic(q, end, *(np.append(rng.normal(size=len(low)) * 0.3, 0.0) for _ in range(2)))


def hidden(world, piece):
    """How much deeper than anything that a sweep sees the deepest is that many looks see, in metres."""
    seen = np.min([look.gaps for _, look in sweep(world, piece)], axis=0)
    found = seen >= -CONTACT  # a pair that is known to collide is looked at no more closely
    deepest = np.full(len(seen), HORIZON)
    for u in np.linspace(0.0, 1.0, DENSE):
        world.move(piece.at(float(u)))
        deepest = np.minimum(deepest, world.look().gaps)
    return float((np.minimum(seen, 0.0) - np.minimum(deepest, 0.0))[found].max(initial=0.0))


@pytest.mark.parametrize("robot", ROBOTS)
def test_nothing_hides_between_two_looks(robots, checkers, robot):
    for seed in range(4):
        rng = np.random.default_rng(seed)
        with connect() as client:
            world, q = random_world(client, robots[robot], checkers, rng)
            assert hidden(world, random_piece(world, q, rng)) <= STEP / 2, f"seed {seed}"


@pytest.mark.slow
@pytest.mark.parametrize("robot", ROBOTS)
def test_nothing_hides_between_two_looks_in_many_worlds(robots, checkers, robot):
    for seed in range(1000, 1020):
        rng = np.random.default_rng(seed)
        with connect() as client:
            world, q = random_world(client, robots[robot], checkers, rng)
            for _ in range(3):
                assert hidden(world, random_piece(world, q, rng)) <= STEP / 2, f"seed {seed}"


@pytest.mark.parametrize("robot", ROBOTS)
def test_the_boxes_around_links_hold_what_touches(robots, checkers, robot):
    """Each point of a link that PyBullet names as nearest to something is within the box around that link."""
    points = 0
    for seed in range(5):
        rng = np.random.default_rng(seed)
        with connect() as client:
            world, q = random_world(client, robots[robot], checkers, rng)
            arm = world.arm
            for _ in range(5):
                world.move(np.append(rng.uniform(*arm.limits.T), q[-1]))
                corners = dict(zip(arm.solid, arm.corners(), strict=True))
                for body in range(client.getNumBodies()):
                    for row in client.getClosestPoints(arm.body, body, 0.3) if body != arm.body else ():
                        box, point = corners[row[3]], np.array(row[5])
                        edges = box[[4, 2, 1]] - box[0]  # along its x, y and z
                        inside = (edges @ (point - box[0])) / (edges**2).sum(axis=1)
                        slack = 0.001 / np.linalg.norm(edges, axis=1)
                        assert ((-slack <= inside) & (inside <= 1 + slack)).all()
                        points += 1
    assert points > 100


@pytest.mark.parametrize("robot", ROBOTS)
def test_no_point_moves_farther_than_the_lever_says(robots, checkers, robot):
    for seed in range(5):
        rng = np.random.default_rng(seed)
        with connect() as client:
            world, a = random_world(client, robots[robot], checkers, rng)
            for _ in range(20):
                b = np.append(rng.uniform(*world.arm.limits.T), rng.uniform(0.0, 0.08))
                looks = []
                for q in (a, b):
                    world.move(q)
                    looks.append(world.look().corners)
                farthest = np.linalg.norm(looks[1] - looks[0], axis=2).max()
                assert farthest <= world.lever * np.abs(b - a).sum()


SWING = """
<robot name="swing">
  <link name="base"/>
  <link name="hub"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="rod"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="hub"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="hub"/><child link="rod"/>
    <axis xyz="1 0 0"/><limit lower="0" upper="2" effort="1" velocity="1"/></joint>
</robot>
"""


def test_a_slide_makes_a_lever_longer(tmp_path):
    """A rod that slides out by 2 m, on a hub that turns; there is nothing else that it could touch."""
    (tmp_path / "swing.urdf").write_text(SWING)
    robot = RobotDescription(
        name="swing",
        urdf=str(tmp_path / "swing.urdf"),
        arm_joints=("turn", "slide"),
        tool_link="rod",
        home=(0.0, 0.0),
        suction=SuctionGripper(links=("rod",), cup_radius=0.01),
    )
    with connect() as client:
        world = PlainWorld(client, robot, (), ())
        assert 2.0 < world.lever < 2.2
        (first, last) = (look for _, look in sweep(world, line(np.array((0.0, 2.0, 0.0)), np.array((0.1, 2.0, 0.0)))))
    travel = np.linalg.norm(last.corners - first.corners, axis=2).max()
    assert 0.2 < travel < 0.1 * world.lever


def test_the_distance_to_the_surface_of_a_box():
    """Against the nearest of many points on its faces."""
    rng = np.random.default_rng(0)
    size = np.array((0.2, 0.1, 0.06))
    frame = ((0.3, -0.2, 0.5), tuple(np.array((0.1, 0.5, -0.3, 0.8)) / np.linalg.norm((0.1, 0.5, -0.3, 0.8))))
    faces = rng.uniform(-0.5, 0.5, (6, 4000, 3))
    for face in range(6):
        faces[face, :, face // 2] = 0.5 if face % 2 else -0.5
    surface = (faces.reshape(-1, 3) * size) @ matrix(frame[1]).T + frame[0]
    local = rng.uniform(-1.0, 1.0, (50, 3))
    points = (local * size) @ matrix(frame[1]).T + frame[0]
    nearest = np.linalg.norm(points[:, None] - surface[None], axis=2).min(axis=1)
    inside = (np.abs(local) < 0.5).all(axis=1)
    expected = np.where(inside, -nearest, nearest)
    np.testing.assert_allclose(surface_distance(points, frame, size), expected, atol=4e-3)
    assert 2 < inside.sum() < 48


def test_the_corners_are_those_of_the_unit_cube():
    assert sorted(map(tuple, CORNERS.tolist())) == [
        (x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)
    ]
