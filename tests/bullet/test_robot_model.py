"""A robot model is a description that fits its URDF file, and says so where it does not."""

from __future__ import annotations

import numpy as np
import pytest
from branching_arm import IN_PYBULLETS_ORDER, JOINTS, branching_arm, urdf

from llm3.errors import InputError
from llm3_bullet.model import RobotModel

ALL_JOINTS = "j1, j2, j3, f1, f2, end, hold, zoom, lid, pole"


@pytest.fixture
def model(tmp_path):
    return RobotModel(branching_arm(tmp_path))


def test_links_are_numbered_from_the_base(model):
    assert model.links == IN_PYBULLETS_ORDER
    assert [model.link(name) for name in model.links] == list(range(len(model.links)))


def test_joints_carry_the_link_of_the_next_number(model):
    assert [model.joint(joint.name) for joint in model.joints] == list(range(len(model.joints)))
    for number, joint in enumerate(model.joints):
        assert model.link(joint.child) == number + 1
        assert model.link(joint.parent) == model.parents[number + 1]
    assert model.parents[0] == -1


def test_arm_fingers_and_tool_are_those_of_the_description(model):
    assert [model.joints[number].name for number in model.arm_joints] == ["j1", "j2", "j3"]
    assert [model.joints[number].name for number in model.finger_joints] == ["f1", "f2"]
    assert model.links[model.tool] == "tip"
    assert model.dof == 3
    assert model.home.tolist() == [0.0, 0.1, 0.2]


def test_limits_are_the_urdfs_unless_the_description_has_others(tmp_path, model):
    assert (model.low.tolist(), model.high.tolist()) == ([-3, -0.1, -2], [2, 0.4, 4])
    narrow = RobotModel(branching_arm(tmp_path, joint_limits={"j1": (-1.0, 1.0), "j3": (-2.0, 4.0)}))
    assert (narrow.low.tolist(), narrow.high.tolist()) == ([-1, -0.1, -2], [1, 0.4, 4])


def test_within_limits_is_asked_of_every_joint(model):
    beyond = np.array([0.0, 0.01, 0.0])
    Q = np.array([model.low, model.high, model.home, model.low - beyond, model.high + beyond])
    assert model.within_limits(Q).tolist() == [True, True, True, False, False]


def test_limits_and_home_cannot_be_changed(model):
    for array in (model.low, model.high, model.home):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0.0


@pytest.mark.parametrize(
    ("overrides", "sentence"),
    [
        ({"arm_joints": ("j1", "j9")}, f"{{urdf}} has no joint 'j9'; known are {ALL_JOINTS}."),
        ({"joint_limits": {"j9": (0.0, 1.0)}}, f"{{urdf}} has no joint 'j9'; known are {ALL_JOINTS}."),
        ({"tool_link": "hook"}, f"{{urdf}} has no link 'hook'; known are {', '.join(IN_PYBULLETS_ORDER)}."),
        ({"mounted_links": ("foot",)}, f"{{urdf}} has no link 'foot'; known are {', '.join(IN_PYBULLETS_ORDER)}."),
        ({"may_touch": (("arm", "leg"),)}, f"{{urdf}} has no link 'leg'; known are {', '.join(IN_PYBULLETS_ORDER)}."),
        (
            {"arm_joints": ("j1", "j3")},
            "the moving joints from the base to 'tip' are j1, j2, j3, but arm_joints are j1, j3.",
        ),
        (
            {"arm_joints": ("j2", "j1", "j3")},
            "the moving joints from the base to 'tip' are j1, j2, j3, but arm_joints are j2, j1, j3.",
        ),
        (
            {"tool_link": "left"},
            "the moving joints from the base to 'left' are j1, j2, j3, f1, but arm_joints are j1, j2, j3.",
        ),
        (
            {"tool_link": "mast", "arm_joints": ("j1",)},
            "the moving joints from the base to 'mast' are none, but arm_joints are j1.",
        ),
        ({"arm_joints": ()}, "the moving joints from the base to 'tip' are j1, j2, j3, but arm_joints are none."),
        ({"home": (0.0, 0.0)}, "home has 2 values, but there are 3 arm joints."),
        (
            {"home": (0.0, 0.5, 0.0)},
            "home [0.0, 0.5, 0.0] is outside of the joint limits, [-3.0, -0.1, -2.0] to [2.0, 0.4, 4.0].",
        ),
        (
            {"joint_limits": {}},
            "arm joint 'j3' has the limits None, but needs a lower and a higher number; "
            "joint_limits of its description can give them.",
        ),
    ],
)
def test_a_description_that_does_not_fit_is_refused(tmp_path, overrides, sentence):
    with pytest.raises(InputError) as caught:
        RobotModel(branching_arm(tmp_path, **overrides))
    assert str(caught.value) == "robot 'branching': " + sentence.format(urdf=tmp_path / "branching.urdf")


def test_fingers_must_slide(tmp_path):
    text = urdf(JOINTS.replace('name="f2" type="prismatic"', 'name="f2" type="revolute"'))
    with pytest.raises(InputError) as caught:
        RobotModel(branching_arm(tmp_path, text))
    assert str(caught.value) == "robot 'branching': finger joint 'f2' is revolute, but must be prismatic."


def test_an_unknown_link_is_refused(model, tmp_path):
    with pytest.raises(InputError) as caught:
        model.link("hook")
    known = ", ".join(IN_PYBULLETS_ORDER)
    urdf_file = tmp_path / "branching.urdf"
    assert str(caught.value) == f"robot 'branching': {urdf_file} has no link 'hook'; known are {known}."
