"""A robot made of several URDF files is the robot that its parts describe."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from toy_arm import toy_arm

from llm3.errors import InputError
from llm3.types import Pose
from llm3_bullet.clients import connect, quiet
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.mounting import urdf_file
from llm3_bullet.poses import as_matrix
from llm3_bullet.robot import Attachment
from llm3_bullet.robots import iiwa, panda

HOOK = """
<robot name="hook">
  <link name="hook"><collision><geometry><sphere radius="0.02"/></geometry></collision></link>
  <joint name="to_point" type="fixed"><parent link="hook"/><child link="point"/><origin xyz="0 0 0.1"/></joint>
  <link name="point"/>
</robot>
"""
lengths = st.floats(-1.0, 1.0)
quaternions = (
    st.tuples(*[lengths] * 4)
    .map(np.array)
    .filter(lambda q: np.linalg.norm(q) > 0.1)
    .map(lambda q: tuple(q / np.linalg.norm(q)))
)
poses = st.builds(Pose, st.tuples(lengths, lengths, lengths), quaternions)


@pytest.fixture(scope="module")
def toy(tmp_path_factory):
    return toy_arm(tmp_path_factory.mktemp("toy"))


@pytest.fixture(scope="module")
def hook(tmp_path_factory):
    path = tmp_path_factory.mktemp("hook") / "hook.urdf"
    path.write_text(HOOK)
    return path


def test_a_robot_without_parts_is_its_own_file(toy):
    with urdf_file(toy) as file:
        assert file == Path(toy.urdf)


@given(pose=poses)
def test_a_part_stands_where_its_pose_says(toy, hook, pose):
    robot = replace(toy, attachments=(Attachment(urdf=str(hook), link="hand", pose=pose),))
    model = RobotModel(robot)
    frames = Kinematics(model).link_frames(model.home[None], 0.0)[0]
    np.testing.assert_allclose(
        frames[model.link("hook")], frames[model.link("hand")] @ as_matrix(pose), atol=3e-5
    )  # an orientation is rounded to 1e-5


@given(pose=poses)
def test_a_base_moves_all_of_the_robot(toy, pose):
    still, moved = RobotModel(toy), RobotModel(replace(toy, base=pose))
    expected = as_matrix(pose) @ Kinematics(still).link_frames(still.home[None], 0.02)[0]
    frames = Kinematics(moved).link_frames(moved.home[None], 0.02)[0]
    at = [moved.link(name) for name in still.links]
    np.testing.assert_allclose(frames[at], expected, atol=1e-4)


@pytest.mark.parametrize("folder", ["", "arms", "arms/urdf"])
def test_meshes_of_a_ros_package_are_found_from_wherever_the_urdf_stands_in_it(toy, tmp_path, folder):
    """`package://` names a folder above the URDF file, as it does for PyBullet."""
    (tmp_path / "arm_description" / folder).mkdir(parents=True)
    (tmp_path / "arm_description" / "hook.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n")
    mesh = '<mesh filename="package://arm_description/hook.obj"/>'
    part = tmp_path / "arm_description" / folder / "hook.urdf"
    part.write_text(HOOK.replace('<sphere radius="0.02"/>', mesh))
    with urdf_file(replace(toy, attachments=(Attachment(urdf=str(part), link="hand"),))) as file, connect() as client:
        assert f'filename="{tmp_path / "arm_description" / "hook.obj"}"' in file.read_text()
        with quiet():
            assert client.loadURDF(str(file)) >= 0


def test_a_panda_can_stand_on_something():
    raised = RobotModel(replace(panda(), base=Pose((0.0, 0.0, 0.02))))
    tools = [Kinematics(model).tool(model.home[None])[0] for model in (raised, RobotModel(panda()))]
    np.testing.assert_allclose(tools[0][:3, 3] - tools[1][:3, 3], (0.0, 0.0, 0.02), atol=1e-9)
    with urdf_file(raised.description) as file, quiet(), connect() as client:
        assert client.loadURDF(str(file)) >= 0


def test_the_file_is_gone_afterwards_and_pybullet_finds_the_meshes_from_it():
    with connect() as client:
        with urdf_file(iiwa()) as file, quiet():
            body = client.loadURDF(str(file), useFixedBase=True)
        assert not file.exists()
        names = [client.getJointInfo(body, joint)[12].decode() for joint in range(client.getNumJoints(body))]
        assert tuple(names) == RobotModel(iiwa()).links[1:]
        assert all(
            client.getCollisionShapeData(body, joint) for joint in range(len(names)) if names[joint] != "suction_tip"
        )


@pytest.mark.parametrize(
    ("text", "link", "sentence"),
    [
        (HOOK, "nose", "{part} is to be attached to 'nose', but the links of {robot} are {links}."),
        (
            HOOK.replace('"point"', '"hand"'),
            "hand",
            "{part} has a link 'hand', and the robot has one already: rename one of them.",
        ),
        (
            HOOK.replace("to_point", "elbow"),
            "hand",
            "{part} has a joint 'elbow', and the robot has one already: rename one of them.",
        ),
        (
            HOOK.replace("</robot>", '<link name="loose"/></robot>'),
            "hand",
            "the robot file {part}: exactly one link must have no parent, not 2 (hook, loose).",
        ),
        ("<robot/>", "hand", "the robot file {part}: exactly one link must have no parent, not 0 (none)."),
        ("<sdf/>", "hand", "the robot file {part} starts with <sdf>; a URDF file starts with <robot>."),
    ],
)
def test_a_part_that_does_not_fit_is_refused(toy, tmp_path, text, link, sentence):
    part = tmp_path / "part.urdf"
    part.write_text(text)
    with pytest.raises(InputError) as caught:
        RobotModel(replace(toy, attachments=(Attachment(urdf=str(part), link=link),)))
    links = ", ".join(re.findall(r'<link name="(\w+)"', Path(toy.urdf).read_text()))
    assert str(caught.value) == sentence.format(part=part, robot=toy.urdf, links=links)


def test_a_base_needs_a_free_name(toy, tmp_path):
    path = tmp_path / "robot.urdf"
    path.write_text(Path(toy.urdf).read_text().replace('"rail"', '"world"'))
    with pytest.raises(InputError) as caught:
        RobotModel(replace(toy, urdf=str(path), mounted_links=(), base=Pose((0.0, 0.0, 1.0))))
    assert str(caught.value) == (
        f"the robot file {path} has a link 'world' already, so its base cannot be moved: change the joint in it."
    )
