"""What is written and read again is what it was, in every format, and spelled as others read it."""

from __future__ import annotations

import csv
import io
import json

import numpy as np
import pytest
from hypothesis import given, settings
from programs import LIFT, SMALL, programs

from llm3.errors import UsageError
from llm3.export import FORMATS, Deed, Move, Program, read_program, write_program
from llm3.types import Event, EventKind, Pose, Trajectory


@pytest.mark.parametrize("name", FORMATS)
@given(program=programs())
@settings(deadline=None, max_examples=40)
def test_what_is_read_is_what_was_written_to_the_last_digit(name, program):
    for with_accelerations in (False, True):
        content = write_program(program, name, with_accelerations)
        assert FORMATS[name].read(content, "f") == program
        assert write_program(program, name, with_accelerations) == content


@pytest.mark.parametrize("name", FORMATS)
def test_the_ending_of_a_file_tells_its_format(name, cwd):
    file = cwd / f"program{FORMATS[name].ending.upper()}"
    file.write_bytes(write_program(SMALL, name))
    assert read_program(file) == SMALL


def test_another_ending_or_format_is_refused_with_those_that_there_are(cwd):
    with pytest.raises(UsageError) as error:
        read_program(cwd / "program.yaml")
    assert str(error.value).endswith("program.yaml' has none of the endings .json (ros2-json), .csv (csv), .npz (npz).")
    with pytest.raises(UsageError) as error:
        write_program(SMALL, "yaml")
    assert str(error.value) == "unknown format 'yaml'. Known: ros2-json, csv, npz."


def keys(value: object) -> object:
    """The names of all fields, in order, and lists by their first element."""
    if isinstance(value, dict):
        return {name: keys(inner) for name, inner in value.items()}
    return [keys(inner) for inner in value[:1]] if isinstance(value, list) else type(value)


def in_order(text: str) -> object:
    """JSON in which an object is a list of pairs."""
    return json.loads(text, object_pairs_hook=list)


def test_trajectories_are_spelled_as_the_messages_of_ros_2():
    items = json.loads(write_program(SMALL, "ros2-json", with_accelerations=True))["items"]
    seconds = {"sec": int, "nanosec": int}
    point = {
        "positions": [float],
        "velocities": [float],
        "accelerations": [float],
        "effort": [],
        "time_from_start": seconds,
    }
    message = {"header": {"stamp": seconds, "frame_id": str}, "joint_names": [str], "points": [point]}
    assert in_order(json.dumps(keys(items[2]["trajectory"]), default=str)) == in_order(json.dumps(message, default=str))
    first, second, last = items[2]["trajectory"]["points"]
    assert [p["time_from_start"] for p in (first, second, last)] == [
        {"sec": 0, "nanosec": 0},
        {"sec": 0, "nanosec": 500_000_000},
        {"sec": 2, "nanosec": 500_000_000},
    ]
    assert (second["positions"], second["velocities"]) == ([0.25, 1.5], [0.5, -0.25])
    assert items[2]["trajectory"]["header"] == {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""}


def test_what_the_gripper_does_is_spelled_as_a_goal_of_ros_2_and_objects_stand_beside_it():
    text = write_program(SMALL, "ros2-json").decode()
    about = {"action": 1, "text": "pick(['a'], {})"}
    pose = {"position": [0.0, 0.0, 0.1], "orientation": [0.0, 0.0, 0.0, 1.0]}
    file = json.loads(text)
    assert list(file) == ["format", "joint_names", "joint_units", "items"]
    assert file["items"][:2] == [
        {"kind": "gripper", **about, "goal": {"command": {"position": 0.04, "max_effort": 0.0}}},
        {"kind": "attach", **about, "object": "a", "grasp": pose},
    ]
    assert file["items"][3] == {"kind": "detach", "action": 2, "text": "drop(['a'], {})", "object": "a"}
    assert '"goal": {"command": {"position": 0.04, "max_effort": 0.0}}' in text


def test_accelerations_are_left_out_of_messages_but_where_they_are_wanted():
    points = json.loads(write_program(SMALL, "ros2-json"))["items"][2]["trajectory"]["points"]
    assert [point["accelerations"] for point in points] == [[], [], []]


def told_accelerations() -> list[list[float]]:
    points = json.loads(write_program(SMALL, "ros2-json", with_accelerations=True))["items"][2]["trajectory"]["points"]
    return [point["accelerations"] for point in points]


def test_an_acceleration_is_that_of_the_cubics_and_the_mean_of_both_sides_where_it_jumps():
    first, middle, last = told_accelerations()
    just = 1e-9
    before, after = (LIFT.sample([0.5 + side])[2][0] for side in (-just, just))
    np.testing.assert_allclose(first, LIFT.sample([0.0])[2][0])
    np.testing.assert_allclose(middle, (before + after) / 2, rtol=1e-6)
    np.testing.assert_allclose(last, LIFT.sample([2.5])[2][0])


def test_joints_in_another_order_are_understood():
    file = json.loads(write_program(SMALL, "ros2-json"))
    message = file["items"][2]["trajectory"]
    message["joint_names"].reverse()
    for point in message["points"]:
        point["positions"].reverse()
        point["velocities"].reverse()
    assert FORMATS["ros2-json"].read(json.dumps(file).encode(), "f") == SMALL
    rows = list(csv.reader(io.StringIO(write_program(SMALL, "csv").decode())))
    text = io.StringIO()
    csv.writer(text).writerows(row[::-1] for row in rows)
    swapped = FORMATS["csv"].read(text.getvalue().encode(), "f")
    assert swapped.joints == ("arm", "wheel")
    assert [row[::-1] for row in swapped.items[2].trajectory.positions] == list(LIFT.positions)


def test_the_table_has_a_row_for_each_point_and_each_event():
    rows = list(csv.DictReader(io.StringIO(write_program(SMALL, "csv").decode())))
    assert [(row["item"], row["kind"], row["time"]) for row in rows] == [
        ("0", "gripper", ""),
        ("1", "attach", ""),
        ("2", "point", "0.0"),
        ("2", "point", "0.5"),
        ("2", "point", "2.5"),
        ("3", "detach", ""),
        ("4", "point", "0.0"),
    ]
    assert rows[3] == {
        **dict.fromkeys(rows[3], ""),
        "item": "2",
        "kind": "point",
        "action": "1",
        "text": "pick(['a'], {})",
        "segment": "lift",
        "time": "0.5",
        "wheel position [m]": "0.25",
        "arm position [rad]": "1.5",
        "wheel velocity [m/s]": "0.5",
        "arm velocity [rad/s]": "-0.25",
        **dict(
            zip(
                ("wheel acceleration [m/s^2]", "arm acceleration [rad/s^2]"),
                map(str, told_accelerations()[1]),
                strict=True,
            )
        ),
    }
    assert (rows[0]["opening"], rows[1]["object"], rows[1]["grasp_z"], rows[1]["grasp_qw"]) == (
        "0.04",
        "a",
        "0.1",
        "1.0",
    )


def test_numpy_reads_the_arrays_without_pickle(cwd):
    (cwd / "p.npz").write_bytes(write_program(SMALL, "npz"))
    with np.load(cwd / "p.npz", allow_pickle=False) as arrays:
        assert arrays["joint_names"].tolist() == ["wheel", "arm"]
        assert arrays["item_kind"].tolist() == ["gripper", "attach", "trajectory", "detach", "trajectory"]
        begin, end = arrays["item_points"][2:4]
        assert arrays["point_time"][begin:end].tolist() == [0.0, 0.5, 2.5]
        np.testing.assert_array_equal(arrays["point_position"][begin:end], LIFT.positions)
        np.testing.assert_array_equal(arrays["point_velocity"][begin:end], LIFT.velocities)
        np.testing.assert_array_equal(arrays["point_acceleration"][begin:end], told_accelerations())
        assert np.isnan(arrays["item_opening"][1:]).all()


def test_the_duration_is_that_of_all_motions_and_times_are_nanoseconds():
    assert SMALL.duration == 2.5
    third = Trajectory((0.0, 1 / 3), ((0.0,), (1.0,)), ((0.0,), (0.0,)))
    assert Move(1, "go", "way", third).trajectory.times == (0.0, 0.333333333)


GRASP = Pose((0, 0, 0))


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: Program((), (), ()), "a program needs joints with different names, not none"),
        (lambda: Program(("a", "a"), ("m", "m"), ()), "a program needs joints with different names, not a, a"),
        (lambda: Program(("a",), (), ()), "each of the 1 joints needs a unit, and there are 0"),
        (lambda: Program(("a",), ("[m]",), ()), "a unit has no brackets, and '[m]' has"),
        (
            lambda: Program(("a\n",), ("m",), ()),
            r"the name of a joint must be one line of printable characters, not 'a\n'",
        ),
        (
            lambda: Program(("a",), ("m",), SMALL.items[2:3]),
            "lift of action 1 has 2 joint values, and there are 1 joints",
        ),
        (
            lambda: Program(("a", "b"), ("m", "m"), SMALL.items[::-1]),
            "action 1 pick(['a'], {}) cannot follow action 2 drop(['a'], {})",
        ),
        (lambda: Move(0, "go", "way", LIFT), "the number of an action must be from 1 to 1000000000, not 0"),
        (lambda: Move(1, "go", "", LIFT), "the name of a segment must be one line of printable characters, not ''"),
        (
            lambda: Move(1, "go", "way", Trajectory((0.0, 2e6), ((0.0,),) * 2, ((0.0,),) * 2)),
            "a motion may take 1e+06 s, not 2e+06 s",
        ),
        (
            lambda: Deed(1, "go", Event(EventKind.GRIPPER)),
            "an event of kind gripper has an opening from 0 to 1000 m and nothing else, not "
            "Event(kind=<EventKind.GRIPPER: 'gripper'>, opening=None, object=None, grasp=None)",
        ),
        (
            lambda: Deed(1, "go", Event(EventKind.DETACH, 0.1, "a")),
            "an event of kind detach has an object and nothing else, not "
            "Event(kind=<EventKind.DETACH: 'detach'>, opening=0.1, object='a', grasp=None)",
        ),
        (
            lambda: Deed(1, "go", Event(EventKind.ATTACH)),
            "an event of kind attach has an object, perhaps a grasp, and nothing else, not "
            "Event(kind=<EventKind.ATTACH: 'attach'>, opening=None, object=None, grasp=None)",
        ),
        (
            lambda: Deed(1, "go", Event(EventKind.ATTACH, object=" \t")),
            r"the name of an object must be one line of printable characters, not ' \t'",
        ),
    ],
)
def test_what_makes_no_sense_is_refused_when_it_is_made(make, sentence):
    with pytest.raises(ValueError) as error:
        make()
    assert str(error.value) == sentence
