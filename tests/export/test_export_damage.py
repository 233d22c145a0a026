"""A damaged file is one clear line, whatever was done to it; nothing in it is run, and it takes no memory."""

from __future__ import annotations

import io
import json
import struct
import zipfile

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from programs import SMALL

from llm3.errors import InputError
from llm3.export import FORMATS, Program, archive, read_program, write_program

WHOLE = {name: write_program(SMALL, name, with_accelerations=True) for name in FORMATS}
"""An undamaged file of each format."""


def complaint(name: str, content: bytes) -> str:
    with pytest.raises(InputError) as error:
        FORMATS[name].read(content, "file")
    return str(error.value)


@pytest.mark.parametrize("name", FORMATS)
@given(data=st.data())
@settings(deadline=None, max_examples=60)
def test_altered_bytes_are_another_program_or_one_line(name, data):
    content = bytearray(WHOLE[name])
    change = st.tuples(st.integers(0, len(content) - 1), st.integers(0, 255))
    for place, byte in data.draw(st.lists(change, max_size=3)):
        content[place] = byte
    begin, end = sorted(data.draw(st.tuples(*[st.integers(0, len(content))] * 2)))
    if data.draw(st.booleans()):
        del content[begin:end]
    said = "file: "
    try:
        assert isinstance(FORMATS[name].read(bytes(content), "file"), Program)
    except InputError as error:
        said = str(error)
    assert said.startswith("file: ")
    assert "\n" not in said


@pytest.mark.parametrize("name", FORMATS)
def test_half_a_file_is_refused(name):
    assert complaint(name, WHOLE[name][: len(WHOLE[name]) // 2]).startswith("file: ")


def test_a_file_that_is_not_there_is_told(cwd):
    with pytest.raises(InputError) as error:
        read_program(cwd / "none.csv")
    assert str(error.value) == f"{cwd / 'none.csv'}: No such file or directory"


# ---- ros2-json ----------------------------------------------------------------------------------------------------


def changed(change) -> bytes:
    file = json.loads(WHOLE["ros2-json"])
    change(file, file["items"])
    return json.dumps(file).encode()


def message(items) -> dict:
    return items[2]["trajectory"]


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (
            lambda file, items: file.update(format="llm3-program/9"),
            "the format is 'llm3-program/9', and this version reads 'llm3-program/1'",
        ),
        (
            lambda file, items: items[0].update(kind="squeeze"),
            "Invalid enum value 'squeeze' - at `$.items[0].kind`; valid: 'attach', 'detach', 'gripper', 'trajectory'",
        ),
        (
            lambda file, items: message(items)["joint_names"].pop(),
            "a trajectory is for wheel, not wheel, arm",
        ),
        (
            lambda file, items: message(items)["points"][1]["velocities"].pop(),
            "every point of a trajectory needs 2 velocities",
        ),
        (
            lambda file, items: message(items)["points"][1]["accelerations"].clear(),
            "every point of a trajectory needs 2 accelerations",
        ),
        (
            lambda file, items: message(items)["points"][1]["accelerations"].__setitem__(1, 0.0),
            "the acceleration of joint value 1 at point 1 of a trajectory is 0, and its positions and velocities make "
            "it -7.875",
        ),
        (
            lambda file, items: message(items)["points"][1]["effort"].append(1.0),
            "the effort of a trajectory's points must be empty: nothing here reads it",
        ),
        (
            lambda file, items: message(items)["points"].reverse(),
            "a trajectory's times must begin with 0 and increase, and (2.5, 0.5, 0.0) do not",
        ),
        (
            lambda file, items: message(items)["points"].clear(),
            "a trajectory's times must begin with 0 and increase, and () do not",
        ),
        (
            lambda file, items: message(items)["points"][1]["time_from_start"].update(nanosec=10**9),
            "no time has 0 s and 1000000000 ns - at `$.items[2].trajectory.points[1].time_from_start`",
        ),
        (
            lambda file, items: items[2].update(object="a"),
            "a trajectory of action 1 needs segment and trajectory, and nothing else",
        ),
        (
            lambda file, items: items[0].update(segment="lift"),
            "a gripper of action 1 has neither segment nor trajectory",
        ),
        (
            lambda file, items: items[0].update(rate=5),
            "unknown field `rate`, expected kind, action, text, segment, trajectory, goal, object, grasp - at "
            "`$.items[0]`",
        ),
    ],
)
def test_what_is_wrong_with_messages_is_told(change, sentence):
    assert complaint("ros2-json", changed(change)) == f"file: {sentence}"


# ---- csv ----------------------------------------------------------------------------------------------------------


def replaced(before: str, after: str) -> bytes:
    text = WHOLE["csv"].decode()
    assert before in text
    return text.replace(before, after, 1).encode()


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"", "there must be one column 'item', and there are 0"),
        (replaced("arm velocity", "arm speed"), "there must be one column 'arm velocity [rad/s]', and there are 0"),
        (
            replaced("opening", "opening,width"),
            "unknown column 'width', expected item, kind, action, text, segment, time, wheel position [m], arm "
            "position [rad], wheel velocity [m/s], arm velocity [rad/s], wheel acceleration [m/s^2], arm acceleration "
            "[rad/s^2], opening, object, grasp_x, grasp_y, grasp_z, grasp_qx, grasp_qy, grasp_qz, grasp_qw",
        ),
        (
            replaced("lift,0.5,0.25", "lift,0.5,fast"),
            "row 4 has 'fast' in the column 'wheel position [m]', and should have a number",
        ),
        (
            replaced("lift,0.5,0.25", "lift,0.5,nan"),
            "row 4 has 'nan' in the column 'wheel position [m]', and should have a number",
        ),
        (replaced("lift,0.5,0.25", "lift,0.5"), "row 4 has 20 cells, and the header has 21"),
        (
            replaced("0,gripper,1", "0,gripper,one"),
            "row 1 has 'one' in the column 'action', and should have a whole number",
        ),
        (replaced("0,gripper", "0,squeeze"), "row 1 is of kind 'squeeze'; valid: point, gripper, attach, detach"),
        (replaced("lift,0.5", "drop,0.5"), "row 3 and those after it have one item, and differ in what they are about"),
        (
            replaced("0,gripper,1,\"pick(['a'], {})\",,", "0,gripper,1,\"pick(['a'], {})\",,3"),
            "row 1 is an event, and has what only points have, or stands for several",
        ),
        (WHOLE["csv"] + b"\xff", "not UTF-8 text: invalid start byte at byte 706"),
    ],
)
def test_what_is_wrong_with_a_table_is_told(content, sentence):
    assert complaint("csv", content) == f"file: {sentence}"


def test_a_point_that_is_an_event_as_well_is_refused():
    rows = [line.split(",") for line in WHOLE["csv"].decode().splitlines()]
    rows[3][rows[0].index("object") + 1] = "b"  # the text of the action has a comma
    assert complaint("csv", "\n".join(map(",".join, rows)).encode()) == (
        "file: row 3 or one after it is a point, and has what only events have"
    )


# ---- npz ----------------------------------------------------------------------------------------------------------


def arrays(**other: np.ndarray) -> bytes:
    with np.load(io.BytesIO(WHOLE["npz"])) as there:
        packed = io.BytesIO()
        np.savez(packed, **{**there, **other})
        return packed.getvalue()


def members(**other: bytes) -> bytes:
    """The archive with other bytes in place of some arrays."""
    packed = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(WHOLE["npz"])) as there, zipfile.ZipFile(packed, "w") as made:
        for name in there.namelist():
            made.writestr(name, other.get(name.removesuffix(".npy"), there.read(name)))
    return packed.getvalue()


class Bomb:
    def __reduce__(self):
        return (pytest.fail, ("it was unpickled",))


def npy(header: str, content: bytes = b"", version: tuple[int, int] = (1, 0)) -> bytes:
    return b"\x93NUMPY" + bytes(version) + struct.pack("<H", len(header)) + header.encode("latin1") + content


NAMES = (
    "joint_names, joint_units, item_kind, item_action, item_text, item_segment, item_opening, item_object, item_grasp, "
    "item_points, point_time, point_position, point_velocity, point_acceleration"
)


@pytest.mark.parametrize(
    ("content", "sentence"),
    [
        (b"", "not a whole .npz file: File is not a zip file"),
        (arrays(more=np.zeros(1)), f"the arrays are {NAMES}, more, and should be {NAMES}"),
        (
            arrays(point_time=np.zeros((4, 1))),
            "the array 'point_time' has the dtype float64 and 2 dimensions, and should have a dtype of kind 'f' and 1",
        ),
        (
            arrays(item_action=np.zeros(5)),
            "the array 'item_action' has the dtype float64 and 1 dimensions, and should have a dtype of kind 'i' and 1",
        ),
        (
            arrays(point_position=np.zeros((4, 3))),
            "the array 'point_position' has the shape (4, 3), and should have (4, 2)",
        ),
        (
            arrays(item_points=np.array([0, 0, 9, 3, 3, 4])),
            "the array 'item_points' must go from 0 to the number of points, and never back",
        ),
        (arrays(item_segment=np.array(["x"] * 5)), "item 0 is an event, and has what only trajectories have"),
        (
            arrays(item_object=np.array(["x"] * 5)),
            "an event of kind gripper has an opening from 0 to 1000 m and nothing "
            "else, not Event(kind=<EventKind.GRIPPER: 'gripper'>, opening=0.04, object='x', grasp=None)",
        ),
        (
            arrays(item_opening=np.ones(5)),
            "an event of kind attach has an object, perhaps a grasp, and nothing else, not "
            "Event(kind=<EventKind.ATTACH: 'attach'>, opening=1.0, object='a', grasp=Pose(position=(0.0, 0.0, 0.1), "
            "orientation=(0.0, 0.0, 0.0, 1.0)))",
        ),
        (
            arrays(item_kind=np.array(["squeeze"] * 5)),
            "an item is of kind 'squeeze'; valid: trajectory, gripper, attach, detach",
        ),
        (
            arrays(item_text=np.array([Bomb()] * 5, dtype=object)),
            "item_text.npy: the dtype object, and texts and numbers are read",
        ),
        (
            members(point_time=npy("{'descr': '<f8', 'fortran_order': False, 'shape': (10000000000000,)}\n")),
            "point_time.npy: 0 bytes, and the shape (10000000000000,) of float64 needs others",
        ),
        (
            members(point_time=npy("{'descr': '<f8', 'fortran_order': False, 'shape': (-1,)}\n")),
            "point_time.npy: 0 bytes, and the shape (-1,) of float64 needs others",
        ),
        (
            members(point_time=npy("{'descr': '<f8', 'fortran_order': False, 'shape': (0L,)}\n")),
            "point_time.npy: its header is not as numpy writes it",
        ),
        (
            members(point_time=npy("{'descr': '<f8', 'fortran_order': False, 'shape': ((0,)}\n")),
            "point_time.npy: its header is not as numpy writes it",
        ),
        (
            members(joint_names=npy("{'descr': '<U0', 'fortran_order': False, 'shape': (50000000,)}\n")),
            "joint_names.npy: the dtype <U0, and texts and numbers are read",
        ),
        (
            members(joint_names=npy("{'descr': '<U1', 'fortran_order': False, 'shape': (1,)}\n", b"\xff" * 4)),
            "joint_names.npy: a text holds what is no character",
        ),
        (
            members(point_time=npy("", version=(3, 0))),
            "point_time.npy: version 3.0 of the .npy format, and 1.0 is read",
        ),
    ],
)
def test_what_is_wrong_with_arrays_is_told(content, sentence):
    assert complaint("npz", content) == f"file: {sentence}"


def test_an_archive_that_would_fill_the_memory_is_refused_before_it_is_unpacked(monkeypatch):
    assert archive.MOST_BYTES == 256 * 2**20
    monkeypatch.setattr(archive, "MOST_BYTES", 2**20)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as made:
        for name in NAMES.split(", "):
            made.writestr(f"{name}.npy", bytes(2**17))
    assert len(packed.getvalue()) < 2**13
    assert complaint("npz", packed.getvalue()) == "file: the arrays have 1835008 bytes, and at most 1048576 are read"


def test_an_archive_is_unpacked_as_numpy_packs_it_only():
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_BZIP2) as made:
        for name in NAMES.split(", "):
            made.writestr(f"{name}.npy", b"")
    assert complaint("npz", packed.getvalue()) == (
        "file: joint_names.npy is compressed in a way that numpy does not use"
    )
