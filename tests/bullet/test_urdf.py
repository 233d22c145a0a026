"""URDF files are read as PyBullet reads them, and a file that is no good is refused in a sentence."""

from __future__ import annotations

import numpy as np
import pytest
from branching_arm import IN_PYBULLETS_ORDER, JOINTS, LINKS, urdf

from llm3.errors import InputError
from llm3_bullet.clients import connect, quiet
from llm3_bullet.urdf import read_urdf


@pytest.fixture
def read(tmp_path):
    def read(text):
        path = tmp_path / "robot.urdf"
        path.write_text(text)
        return read_urdf(path)

    return read


@pytest.fixture
def refusal(read, tmp_path):
    """What is said about a file, without its name."""

    def refusal(text):
        with pytest.raises(InputError) as caught:
            read(text)
        sentence, opening = str(caught.value), f"the robot file {tmp_path / 'robot.urdf'}"
        assert sentence.startswith(opening)
        return sentence.removeprefix(opening).removeprefix(": ").strip()

    return refusal


def test_links_come_in_pybullets_order_whatever_the_files(read, tmp_path):
    robot = read(urdf())
    assert robot.links == IN_PYBULLETS_ORDER
    with connect() as client, quiet():
        body = client.loadURDF(str(tmp_path / "robot.urdf"), useFixedBase=True)
        infos = [client.getJointInfo(body, number) for number in range(client.getNumJoints(body))]
    assert [info[12].decode() for info in infos] == list(robot.links[1:])
    assert [info[1].decode() for info in infos] == [joint.name for joint in robot.joints]


def test_each_joint_carries_the_link_after_its_place(read):
    robot = read(urdf())
    assert [joint.child for joint in robot.joints] == list(robot.links[1:])


def test_axes_are_unit_vectors_and_origins_are_rigid(read):
    for joint in read(urdf()).joints:
        assert np.linalg.norm(joint.axis) == pytest.approx(1.0)
        np.testing.assert_allclose(joint.origin[:3, :3] @ joint.origin[:3, :3].T, np.eye(3), atol=1e-12)
        assert np.linalg.det(joint.origin[:3, :3]) == pytest.approx(1.0)
        assert joint.origin[3].tolist() == [0, 0, 0, 1]


def test_what_a_joint_does_not_say_is_the_formats_default(read):
    (joint,) = read(
        '<robot><link name="a"/><link name="b"/><joint name="j" type="continuous"><parent link="a"/><child link="b"/>'
        "</joint></robot>"
    ).joints
    np.testing.assert_array_equal(joint.origin, np.eye(4))
    assert joint.axis.tolist() == [1, 0, 0]
    assert joint.limits is None


def test_a_missing_file(tmp_path):
    with pytest.raises(InputError) as caught:
        read_urdf(tmp_path / "none.urdf")
    assert str(caught.value) == f"the robot file {tmp_path / 'none.urdf'} cannot be read: No such file or directory."


def two_links(joint):
    return f'<robot><link name="a"/><link name="b"/>{joint}</robot>'


def hinge(inside="", name="j", kind="revolute", parent="a", child="b"):
    ends = f'<parent link="{parent}"/><child link="{child}"/>'
    return f'<joint name="{name}" type="{kind}">{ends}{inside}</joint>'


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("<robot>", "is not XML: no element found: line 1, column 7."),
        ("<sdf/>", "starts with <sdf>; a URDF file starts with <robot>."),
        (
            "<robot/>",
            "exactly one link must have no parent, not 0 (none); its links are none.",
        ),
        ("<robot><link/></robot>", "a <link> lacks the attribute 'name'."),
        (two_links("<joint/>"), "a <joint> lacks the attribute 'name'."),
        (two_links('<joint name="j"/>'), "joint 'j' lacks the attribute 'type'."),
        (
            two_links('<joint name="j" type="fixed"/>'),
            "the <parent> of joint 'j' lacks the attribute 'link'.",
        ),
        (
            two_links('<joint name="j" type="fixed"><parent link="a"/><child/></joint>'),
            "the <child> of joint 'j' lacks the attribute 'link'.",
        ),
        (
            two_links(hinge(kind="planar")),
            "joint 'j' is of type 'planar'; known types are continuous, fixed, prismatic, revolute.",
        ),
        (
            two_links(hinge(child="c")),
            "joint 'j' names the link 'c', which is not there; its links are a, b.",
        ),
        (
            two_links(hinge() + hinge(name="k")),
            "link 'b' hangs on two joints, 'j' and 'k'.",
        ),
        (two_links(""), "exactly one link must have no parent, not 2 (a, b); its links are a, b."),
        (
            two_links(hinge() + hinge(name="k", parent="b", child="a")),
            "exactly one link must have no parent, not 0 (none); its links are a, b.",
        ),
        (
            f'<robot><link name="root"/><link name="a"/><link name="b"/>{hinge()}'
            f"{hinge(name='k', parent='b', child='a')}</robot>",
            "these links hang in a loop, not on the base 'root': a, b.",
        ),
        (
            two_links(hinge('<axis xyz="0 0 0"/>')),
            "the <axis> of joint 'j' is 0 0 0; a moving joint needs a direction.",
        ),
        (
            two_links(hinge('<axis xyz="1 1 0"/>', kind="prismatic")),
            "the <axis> of joint 'j' has the length 1.41421; a prismatic joint needs length 1.",
        ),
        (
            two_links(hinge('<origin xyz="1 2"/>')),
            "xyz='1 2' in the <origin> of joint 'j' must be 3 numbers.",
        ),
        (
            two_links(hinge('<origin rpy="0 0 nan"/>')),
            "rpy='0 0 nan' in the <origin> of joint 'j' must be 3 numbers.",
        ),
        (
            two_links(hinge('<limit lower="low" upper="1"/>')),
            "lower='low' in the <limit> of joint 'j' must be a number.",
        ),
    ],
)
def test_a_flaw_is_named(refusal, text, sentence):
    assert refusal(text) == sentence


def test_a_duplicate_link_is_named(refusal):
    assert refusal(urdf(JOINTS, (*LINKS, "mast"))) == "two links are called 'mast'."


def test_a_duplicate_joint_is_named(refusal):
    text = '<robot><link name="a"/><link name="b"/><link name="c"/>' + hinge() + hinge(child="c") + "</robot>"
    assert refusal(text) == "two joints are called 'j'."
