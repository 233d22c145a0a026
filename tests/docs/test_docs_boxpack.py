from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from docs_pages import ROOT, blocks, names, page, table, tables
from scipy.spatial.transform import Rotation

from llm3.jsonio import loads
from llm3.types import Contact, Failure, FailureKind, Held, Pose, State
from llm3_boxpack import goal, instance, layout, paper_settings
from llm3_boxpack.domain import BoxPack
from llm3_boxpack.instance import MAX_WALL_HEIGHT, BasketSpec, BoxpackInstance, BoxSpec, ClutterSpec
from llm3_bullet.poses import as_matrix, as_pose
from llm3_bullet.robot import ParallelGripper
from llm3_bullet.settle import SettlerSettings
from llm3_bullet.tabletop import grasps, manipulation, stance, surprises, tabletop
from llm3_bullet.tabletop import table as tabletop_table
from llm3_bullet.touchdown import CUT_SHORT, TouchdownSettings
from llm3_words.sentences import FEASIBLE, sentence_of

PAGE = page("boxpack")
SIZES = {"red_box": (0.07, 0.07, 0.07), "blue_box": (0.07, 0.07, 0.07)}
PROBLEM = BoxpackInstance(
    BasketSpec((0.65, 0.0), (0.22, 0.21)),
    tuple(BoxSpec(name, size, (0.39, y)) for (name, size), y in zip(SIZES.items(), (-0.3, 0.3), strict=True)),
)
GRIPPER = ParallelGripper(
    joints=("left", "right"),
    links=("hand",),
    max_opening=0.08,
    finger_reach=0.0264,
    closing_axis=(0.0, 1.0, 0.0),
    palm_height=0.039,
)


def numbers(cell: str) -> tuple[float, ...]:
    return tuple(float(part) for part in cell.split(","))


def told() -> list[str]:
    """All sentences in backticks in a list or in the last column of a table."""
    listed = [line.removeprefix("- `").removesuffix("`") for line in PAGE.splitlines() if line.startswith("- `")]
    return listed + [row[-1].strip("`") for t in tables(PAGE) for row in t.rows]


# ---- the problem -------------------------------------------------------------------------------------------------


def test_the_sizes_are_those_of_the_settings():
    boxes: dict[str, dict[str, tuple[float, ...]]] = {}
    for kind, name, size in table(PAGE, "Settings", "boxes").rows:
        boxes.setdefault(kind.strip("`"), {})[name.strip("`")] = numbers(size)
    assert boxes == paper_settings.BOX_SETS
    baskets = {
        name.strip("`"): BasketSpec(numbers(center), numbers(size))
        for name, center, size in table(PAGE, "Settings", "basket").rows
    }
    assert baskets == paper_settings.BASKETS
    assert f"The default is `{BoxPack.default_setting}`" in PAGE.replace("\n", " ")


def test_where_boxes_start():
    (low_x, high_x), (low_y, high_y) = paper_settings.START_X, paper_settings.START_Y
    assert f"x between {low_x} and {high_x} and y between {low_y} and {high_y}" in PAGE


def test_the_options_are_those_of_the_domain():
    shown = [(name.strip("`"), default.strip("`")) for name, default, _ in table(PAGE, "Options").rows]
    assert shown == [(option.name, option.default) for option in BoxPack.options]
    assert f"0 to {MAX_WALL_HEIGHT:g} m, or `own` for those of the problem" in PAGE
    assert f"they are {layout.WALL_THICKNESS * 1000:g} mm thick" in PAGE


def test_the_example_of_an_instance_file_loads():
    (example,) = blocks(PAGE, "json")
    loaded = loads(example.text, BoxpackInstance, "docs/boxpack.md")
    assert [box.name for box in loaded.boxes] == ["red_box", "green_box"]


@pytest.mark.parametrize(
    ("column", "structure"),
    [
        ("field", BoxpackInstance),
        ("field of the basket", BasketSpec),
        ("field of a box, or of clutter", BoxSpec),
        ("field of a box, or of clutter", ClutterSpec),
    ],
)
def test_every_field_of_an_instance_file_is_documented(column, structure):
    shown = table(PAGE, "Instance files", column)
    assert shown.names == tuple(field.name for field in dataclasses.fields(structure))


def test_the_limits_of_an_instance_file_are_those_of_its_sentences():
    with pytest.raises(ValueError, match=r"0\.005 to 0\.5 m"):
        BoxSpec("red_box", (0.001, 0.1, 0.1), (0.4, 0.0))
    with pytest.raises(ValueError, match=r"0\.02 to 2 m"):
        BasketSpec((0.5, 0.0), (0.01, 0.2))
    assert "0.005 to 0.5 m each" in PAGE
    assert "0.02 to 2 m" in PAGE
    corners = tabletop_table.TABLE_TOP.corners
    (low_x, low_y), (high_x, high_y) = corners.min(axis=0), corners.max(axis=0)
    assert f"x from {low_x} to {high_x} m and y from {low_y} to {high_y} m" in PAGE


def test_the_harder_settings_are_those_of_the_families():
    shown = [name.strip("` ") for row in table(PAGE, "Harder settings", "setting").rows for name in row[0].split(",")]
    assert (*paper_settings.SETTINGS, *shown) == BoxPack.settings


# ---- figures -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        f"a plate of {instance.TRAY_THICKNESS * 1000:g} mm",
        f"more than {surprises.SLID * 1000:g} mm",
        f"more than {surprises.TURNED:g} rad",
        f"more than {np.degrees(surprises.LEANS):g} degrees",
        f"more than {np.degrees(surprises.TOPPLED):g} degrees",
        f"leans by more than {np.degrees(np.arccos(stance.UPRIGHT)):g} degrees",
        f"The tolerance is {goal.TOLERANCE * 1000:g} mm",
        f"{manipulation.DROP * 1000:g} mm above what it will stand on",
        f"keep {tabletop.CLEARANCE * 1000:g} mm away from everything",
        f"{grasps.OPENING_MARGIN * 1000:g} mm wider than the box",
        f"The widest box that it takes is {GRIPPER.max_opening - grasps.OPENING_MARGIN:g} m",
        f"{grasps.ABOVE_CENTER * 1000:g} mm, or a quarter of the box's height",
        f"stops {grasps.CUP_GAP * 1000:g} mm above the face",
        f"{SettlerSettings().density:g} kg/m³",
        f"friction coefficient {SettlerSettings().friction:g}",
        f"path to {TouchdownSettings().height:g} m above",
        f"checked every {TouchdownSettings().step * 1000:g} mm",
        f"{TouchdownSettings().tolerance * 1000:g} mm of penetration",
        f"up to {TouchdownSettings().enough} goals",
    ],
)
def test_the_page_has_the_figures_of_the_code(text):
    assert text in " ".join(PAGE.split())


def test_the_figures_of_a_grasp():
    shown = {figure: value for figure, value, _ in table(PAGE, "Grasps").rows}
    assert shown["it opens wider than the box by"] == f"{grasps.OPENING_MARGIN * 1000:g} mm"
    assert shown["palm above a tall box at least"] == f"{grasps.PALM_GAP * 1000:g} mm"
    assert shown["largest opening of the gripper"] == f"{GRIPPER.max_opening * 1000:g} mm"
    assert shown["a finger reaches out beyond the face that it grips"] == f"{GRIPPER.finger_reach * 1000:g} mm"


def test_the_figures_of_a_grasp_stand_where_the_page_says():
    for _, _, (name,) in (map(names, row) for row in table(PAGE, "Grasps").rows):
        assert hasattr(grasps if name.isupper() else GRIPPER, name), name
    for file in ("plugins/llm3_bullet/robots/panda.py", "plugins/llm3_bullet/tabletop/grasps.py"):
        assert f"`{file}`" in PAGE
        assert (ROOT / file).is_file()


@pytest.mark.pybullet
def test_the_robot_is_the_panda_of_the_page():
    from llm3_bullet.robots.panda import panda

    robot = panda()
    shown = {name.strip("`"): (float(low), float(high)) for name, low, high in table(PAGE, "The robot").rows}
    assert shown == robot.joint_limits
    assert np.allclose(robot.home, (0, -np.pi / 4, 0, -3 * np.pi / 4, 0, np.pi / 2, np.pi / 4))
    assert GRIPPER.max_opening == robot.gripper.max_opening
    assert GRIPPER.finger_reach == robot.gripper.finger_reach


# ---- sentences ---------------------------------------------------------------------------------------------------


def test_every_failure_of_a_motion_reads_as_documented():
    contacts = {
        FailureKind.GOAL_IN_COLLISION: (Contact("gripper", "blue_box"),),
        FailureKind.START_IN_COLLISION: (Contact("arm", "blue_box"),),
    }
    shown = {kind.strip("`"): sentence.strip("`") for kind, sentence in table(PAGE, "Failures").rows}
    kinds = [kind for kind in FailureKind if kind.is_motion]
    assert shown == {kind.value: sentence_of(Failure(kind, contacts=contacts.get(kind, ()))) for kind in kinds}
    cut_short = sentence_of(Failure(FailureKind.UNREACHABLE, CUT_SHORT))
    for sentence in (FEASIBLE, cut_short):
        assert f"`{sentence}`" in PAGE.replace("\n", " ")


def test_every_precondition_reads_as_documented():
    sizes = {box.name: box.size for box in PROBLEM.boxes}
    pose = Pose((0.4, 0.0, 0.035))
    hands = manipulation.Manipulation(sizes, (), GRIPPER)
    big_hands = manipulation.Manipulation({**sizes, "red_box": (0.1, 0.1, 0.1)}, (), GRIPPER)
    slanted = Pose(pose.position, tuple(Rotation.from_euler("x", 20, degrees=True).as_quat()))
    holding = State({"red_box": pose}, held=Held("blue_box", Pose((0.0, 0.0, 0.0))))
    failures = [
        hands.pick(holding, "red_box"),
        hands.in_hand(State({"red_box": pose}), "red_box"),
        hands.in_hand(holding, "red_box"),
        hands.pick(State({"red_box": slanted}), "red_box"),
        big_hands.pick(State({"red_box": pose}), "red_box"),
    ]
    for failure in failures:
        assert isinstance(failure, Failure)
        assert failure.kind is FailureKind.PRECONDITION
        assert failure.detail in told()


def test_what_physics_does_reads_as_documented():
    def moved(x: float = 0.6, yaw: float = 0.0, tilt: float = 0.0) -> Pose:
        matrix = as_matrix(Pose((x, 0.0, 0.035)))
        matrix[:3, :3] = Rotation.from_euler("zx", (yaw, np.radians(tilt))).as_matrix()
        return as_pose(matrix)

    for after in (moved(x=0.612), moved(yaw=0.2), moved(tilt=20), moved(tilt=90)):
        (note,) = surprises.surprises({"red_box": moved()}, {"red_box": after})
        assert note in told()


def test_what_is_missing_of_the_goal_reads_as_documented():
    inside = Pose((0.65, 0.0, 0.045))
    for state in (
        State({"blue_box": inside}, held=Held("red_box", Pose((0.0, 0.0, 0.0)))),
        State({"blue_box": inside, "red_box": Pose((0.39, 0.0, 0.035))}),
        State({"blue_box": inside, "red_box": Pose((0.65, 0.105 + 0.012 - 0.035, 0.045))}),
    ):
        (sentence,) = goal.goal_status(PROBLEM, state).unmet
        assert sentence in told()
