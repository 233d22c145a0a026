"""A wrong instance file gets one line that names what is wrong; a right one comes back as it was."""

from __future__ import annotations

import copy
import json

import pytest

from llm3.errors import InputError
from llm3.jsonio import loads, pretty
from llm3_tabletop2d.instance import TabletopInstance
from llm3_tabletop2d.settings import SETTINGS, generate

GOOD = {
    "room": [1.2, 0.8],
    "robot": [0.1, 0.4],
    "objects": [
        {"name": "red_disc", "shape": "disc", "size": [0.08, 0.08], "position": [0.5, 0.4]},
        {"name": "blue_box", "shape": "box", "size": [0.1, 0.06], "position": [0.8, 0.2], "theta": 0.5},
    ],
    "regions": [{"name": "tray", "center": [1.0, 0.4], "size": [0.2, 0.4]}],
    "goals": [{"object": "red_disc", "region": "tray"}],
    "walls": [{"name": "post", "center": [0.6, 0.7], "size": [0.04, 0.2]}],
}
TAKEN = "robot, room, outer_wall, itself"
WRONG = [
    ("objects.0.name", 7, "Expected `str`, got `int` 7 - at `$.objects[0].name`"),
    (
        "objects.0.name",
        "red disc",
        "object names are letters, digits and underscores, no digit first, not 'red disc' - at `$.objects[0]`",
    ),
    (
        "walls.0.name",
        "1",
        "wall and region names are letters, digits and underscores, no digit first, not '1' - at `$.walls[0]`",
    ),
    ("objects.0.name", "room", f"nothing can be called 'room'; these names are taken: {TAKEN} - at `$.objects[0]`"),
    ("objects.0.shape", "ball", "Invalid enum value 'ball' - at `$.objects[0].shape`; valid: 'box', 'disc'"),
    ("objects.1.size", [0.1], "Expected `array` of length 2, got 1 - at `$.objects[1].size`"),
    ("objects.1.size.0", 0.0, "the sides of blue_box must be 0.01 to 5 m, not [0.0, 0.06] - at `$.objects[1]`"),
    (
        "objects.0.size.0",
        0.1,
        "red_disc is a disc, so both its sizes must be its diameter, not [0.1, 0.08] - at `$.objects[0]`",
    ),
    ("objects.0.theta", 0.5, "red_disc is a disc, so its theta must be 0, not 0.5 - at `$.objects[0]`"),
    (
        "objects.0.colour",
        "red",
        "unknown field `colour`, expected name, shape, size, position, theta - at `$.objects[0]`",
    ),
    ("objects.1.name", "red_disc", "two things are called red_disc"),
    ("objects.1.name", "tray", "two things are called tray"),
    ("objects", [], "there must be 1 to 50 objects, not 0"),
    ("regions", [], "there must be 1 to 50 regions, not 0"),
    ("goals", [], "there must be 1 to 50 goals, not 0"),
    ("goals.0.object", "red", "a goal is for 'red', and the objects are red_disc, blue_box"),
    ("goals.0.region", "bin", "red_disc belongs in 'bin', and the regions are tray"),
    ("goals", [{"object": "red_disc", "region": "tray"}] * 2, "two goals are for red_disc"),
    ("room.0", 100.0, "the sides of the room must be 0.2 to 10 m, not [100.0, 0.8]"),
    ("regions.0.center.0", 1.15, "tray reaches out of the room of 1.2 by 0.8 m"),
    (
        "regions.0.size",
        [0.05, 0.4],
        "red_disc reaches 0.08 by 0.08 m along x and y, which does not fit into tray of 0.05 by 0.4 m",
    ),
    ("walls.0.size.1", 7.0, "the sides of post must be 0.01 to 5 m, not [0.04, 7.0] - at `$.walls[0]`"),
]


def changed(path: str, value: object) -> str:
    data = copy.deepcopy(GOOD)
    *way, last = (int(key) if key.isdigit() else key for key in path.split("."))
    place = data
    for key in way:
        place = place[key]
    place[last] = value
    return json.dumps(data)


@pytest.mark.parametrize(("path", "value", "sentence"), WRONG)
def test_a_wrong_file_gets_one_line(path, value, sentence):
    with pytest.raises(InputError) as error:
        loads(changed(path, value), TabletopInstance, "mine.json")
    assert str(error.value) in (f"mine.json: {sentence}", f"mine.json: {sentence} - at `$`")


@pytest.mark.parametrize(
    ("path", "sentence"),
    [
        ("robot", "the position of the robot must be finite numbers, not inf"),
        ("objects.0.position", "the position of red_disc must be finite numbers, not inf - at `$.objects[0]`"),
        ("walls.0.center", "the center of post must be finite numbers, not inf - at `$.walls[0]`"),
    ],
)
def test_numbers_without_end_are_refused(path, sentence):
    with pytest.raises(InputError) as error:
        loads(changed(path, "INF").replace('"INF"', "[1e999, 0]"), TabletopInstance, "mine.json")
    assert "mine.json: " in str(error.value)
    assert str(error.value) == f"mine.json: {sentence}" or "out of range" in str(error.value)


def test_too_many_walls_are_refused():
    many = [{"name": f"wall_{i}", "center": [0.6, 0.7], "size": [0.04, 0.2]} for i in range(51)]
    with pytest.raises(InputError) as error:
        loads(changed("walls", many), TabletopInstance, "mine.json")
    assert str(error.value) == "mine.json: there must be 0 to 50 walls, not 51"


def test_a_right_file_is_read_as_it_was_written():
    for setting in SETTINGS:
        instance = generate(setting, 3)
        assert loads(pretty(instance), TabletopInstance, "mine.json") == instance
    assert loads(json.dumps(GOOD), TabletopInstance, "mine.json").region_of("blue_box") is None


@pytest.mark.parametrize("solver", ["loop", "search"])
def test_a_problem_that_is_solved_from_the_start_is_told_to_be_so(command, cwd, solver):
    solved = {**GOOD, "objects": [{**GOOD["objects"][0], "position": [1.0, 0.4]}]}
    (cwd / "solved.json").write_text(pretty(solved), encoding="utf-8")
    ended = command(f"--domain tabletop2d --instance solved.json --solver {solver} --out here")
    assert (ended.code, ended.out) == (0, "")
    *_, summary, reason, record = ended.err.splitlines()
    assert summary.startswith("solved in ")
    assert (reason, record) == ("the goal is reached before anything is done", "record: here")
    assert command("verify here").code == 0
    if solver == "loop":
        again = command("--llm replay:here --out again")
        assert again.code == 0
        assert (cwd / "again/plan.json").read_bytes() == (cwd / "here/plan.json").read_bytes()


def test_a_region_must_hold_its_object_as_it_is_turned():
    data = json.loads(changed("regions.0.size", [0.11, 0.4]))
    loads(json.dumps(data), TabletopInstance, "mine.json")
    data["goals"][0]["object"] = "blue_box"
    with pytest.raises(InputError) as error:
        loads(json.dumps(data), TabletopInstance, "mine.json")
    assert str(error.value) == (
        "mine.json: blue_box reaches 0.117 by 0.101 m along x and y, which does not fit into tray of 0.11 by 0.4 m"
    )
    data["objects"][1]["theta"] = 0.0
    loads(json.dumps(data), TabletopInstance, "mine.json")
