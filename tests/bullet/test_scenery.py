"""The scenery shows each link where PyBullet has it, boxes where they are told to be, and holds no simulator."""

from __future__ import annotations

import numpy as np
import pytest

from llm3.types import Camera, Held, Moment, Pose
from llm3_bullet.clients import connect
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.mounting import urdf_file
from llm3_bullet.poses import as_matrix
from llm3_bullet.robots import iiwa, panda
from llm3_bullet.scene import Box
from llm3_bullet.scenery import BulletScenery

CUBE, POST = (
    Box("cube", (0.1, 0.1, 0.1), Pose((0.6, 0.0, 0.05))),
    Box("post", (0.1, 0.1, 1.0), Pose((0.0, 0.8, 0.5)), fixed=True),
)


@pytest.fixture(scope="module", params=[panda, iiwa])
def model(request):
    return RobotModel(request.param())


@pytest.fixture(scope="module")
def scenery(model):
    return BulletScenery(model, [CUBE, POST], {"cube": (1.0, 0.0, 0.0)}, Camera())


@pytest.fixture
def moment(model):
    return Moment(tuple(model.home), {"cube": Pose((0.5, 0.1, 0.05))}, opening=0.02)


def test_everything_has_a_name_of_its_own_a_kind_and_a_place(scenery, moment):
    names = [body.name for body in scenery.bodies]
    assert len(set(names)) == len(names)
    assert set(names) <= set(scenery.places(moment))
    kinds = {body.name: body.kind for body in scenery.bodies}
    assert (kinds["cube"], kinds["post"]) == ("object", "fixed")
    assert sum(kind == "robot" for kind in kinds.values()) > 7


def test_boxes_have_their_colours_and_their_sizes(scenery):
    cube = next(body for body in scenery.bodies if body.name == "cube")
    (surface,) = cube.surfaces
    assert surface.color == (1.0, 0.0, 0.0)
    assert np.allclose(np.ptp(surface.corners, axis=0), CUBE.size)


def test_boxes_stand_where_the_moment_says_and_furniture_where_it_is(scenery, moment):
    places = scenery.places(moment)
    assert np.allclose(places["cube"], as_matrix(moment.poses["cube"]))
    assert np.allclose(places["post"], as_matrix(POST.pose))


def test_what_is_held_moves_with_the_tool(scenery, model):
    grasp = Pose((0.0, 0.0, 0.05))
    q = model.home + 0.1
    places = scenery.places(Moment(tuple(q), {}, Held("cube", grasp)))
    assert np.allclose(places["cube"], Kinematics(model).tool(q[None])[0] @ as_matrix(grasp))


def test_the_robots_surfaces_are_as_large_as_what_pybullet_shows(scenery, model, moment):
    """Seen from above, the surfaces in their places fill the boxes that PyBullet has around the links."""
    places = scenery.places(moment)
    with connect() as client, urdf_file(model.description) as file:
        robot = client.loadURDF(str(file), useFixedBase=True)
        for joint, value in zip(model.arm_joints, moment.configuration, strict=True):
            client.resetJointState(robot, joint, value)
        for joint in model.finger_joints:
            client.resetJointState(robot, joint, moment.opening / 2)
        for body in (body for body in scenery.bodies if body.kind == "robot"):
            low, high = client.getAABB(robot, model.links.index(body.name) - 1)
            corners = np.vstack([surface.corners for surface in body.surfaces])
            there = corners @ places[body.name][:3, :3].T + places[body.name][:3, 3]
            assert (there.min(axis=0) > np.array(low) - 0.03).all(), body.name
            assert (there.max(axis=0) < np.array(high) + 0.03).all(), body.name
