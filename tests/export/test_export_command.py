"""`llm3 export` writes a file that was checked first, and `llm3 verify --trajectories` looks at what is in it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from command_line import llm3, run

from llm3.export import FORMATS, read_program
from llm3.records import read_plan


@pytest.mark.parametrize("name", FORMATS)
def test_a_run_is_exported_and_what_was_exported_is_sound(command, solved, name):
    file = f"run{FORMATS[name].ending}"
    ended = command(f"export run --format {name}")
    assert (ended.code, ended.out, ended.err) == (0, f"{file}\n", "")
    ended = command(f"verify run --trajectories {file}")
    assert (ended.code, ended.err) == (0, "")
    assert ended.out.startswith("sound: ")


def test_json_is_meant_where_nothing_is_said_and_a_plans_file_is_as_good_as_its_folder(command, solved):
    assert command("export run/plan.json").out == "run.json\n"
    Path("plan2.json").write_bytes(Path("run/plan.json").read_bytes())
    assert command("export plan2.json --out same.json").out == "same.json\n"
    assert Path("same.json").read_bytes() == Path("run.json").read_bytes()


def test_the_ending_of_out_is_the_format(command, solved):
    assert command("export run --out there.npz").code == 0
    assert read_program(Path("there.npz")) == read_program_of(command, "there.csv")


def read_program_of(command, file: str):
    assert command(f"export run --out {file}").code == 0
    return read_program(Path(file))


def test_a_rate_gives_even_points_and_accelerations(command, solved):
    assert command("export run --rate 50").code == 0
    message = next(item for item in json.loads(Path("run.json").read_text())["items"] if item["kind"] == "trajectory")
    points = message["trajectory"]["points"]
    times = [p["time_from_start"]["sec"] * 10**9 + p["time_from_start"]["nanosec"] for p in points]
    assert times == [20_000_000 * number for number in range(len(points))]
    assert all(len(point["accelerations"]) == 2 for point in points)


def test_nothing_is_overwritten_but_by_force(command, solved):
    Path("run.csv").write_text("mine")
    ended = command("export run --format csv")
    assert (ended.code, ended.err) == (2, "llm3: error: 'run.csv' exists: choose another file, or give --force.\n")
    assert Path("run.csv").read_text() == "mine"
    assert command("export run --format csv --force").code == 0
    assert read_program(Path("run.csv")).joints == ("x", "y")


@pytest.mark.parametrize(
    ("flags", "sentence"),
    [
        (
            "--format csv --out run.npz",
            "--format csv makes a .csv, and --out is 'run.npz'.",
        ),
        ("--out run.yaml", "'run.yaml' has none of the endings .json (ros2-json), .csv (csv), .npz (npz)."),
        ("--rate 0", "argument --rate: expected a number from 1 to 1000, not '0'. See 'llm3 export --help'."),
        ("--rate fast", "argument --rate: expected a number from 1 to 1000, not 'fast'. See 'llm3 export --help'."),
    ],
)
def test_what_makes_no_sense_is_a_usage_error(command, solved, flags, sentence):
    ended = command(f"export run {flags}")
    assert (ended.code, ended.out, ended.err) == (2, "", f"llm3: error: {sentence}\n")
    assert sorted(Path().iterdir()) == [Path("run")]


@pytest.mark.parametrize("flags", ["", " --force", " --out ./walk.json --force"])
def test_a_plan_is_never_overwritten_by_its_own_export(command, solved, flags):
    plan = Path("run/plan.json").rename("walk.json").read_bytes()
    ended = command(f"export walk.json{flags}")
    assert (ended.code, ended.err) == (
        2,
        "llm3: error: 'walk.json' is the plan itself: choose another file with --out.\n",
    )
    assert Path("walk.json").read_bytes() == plan


def test_a_file_that_cannot_be_written_leaves_nothing_behind(command, solved):
    Path("there.csv").mkdir()
    ended = command("export run --out there.csv --force")
    assert (ended.code, ended.err) == (3, "llm3: error: 'there.csv' cannot be written: Is a directory.\n")
    assert sorted(Path().iterdir()) == [Path("run"), Path("there.csv")]
    ended = command("export run --out nowhere/there.csv")
    assert ended.err == "llm3: error: 'nowhere/there.csv' cannot be written: No such file or directory.\n"


def altered(change) -> str:
    """Another plan beside the run."""
    plan = json.loads(Path("run/plan.json").read_text())
    change(plan["actions"][0]["motion"]["segments"][0]["trajectory"])
    Path("altered.json").write_text(json.dumps(plan))
    return str(read_plan(Path("altered.json")).actions[0].action)


def test_a_plan_that_the_robot_cannot_follow_is_not_written(command, solved):
    def hurry(trajectory):
        trajectory["times"] = [time / 2 for time in trajectory["times"]]
        trajectory["velocities"] = [[2 * v for v in row] for row in trajectory["velocities"]]

    action = altered(hurry)
    ended = command("export altered.json --format csv")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err.startswith(f"llm3: error: action 1 {action}, transit, 0.")
    assert ended.err.endswith(" m/s, and its limit is 0.5000 m/s.\n")
    assert not Path("altered.csv").exists()


def test_the_limits_are_those_of_the_robot_whatever_the_plan_says_of_them(command, solved):
    plan = json.loads(Path("run/plan.json").read_text())
    for joint in plan["joints"]:
        joint.update(max_velocity=1e-3, max_acceleration=None)
    Path("slow.json").write_text(json.dumps(plan))
    assert command("export slow.json --format csv").code == 0


def test_a_plan_without_times_is_told_how_to_get_them(command):
    assert command("--domain tabletop2d --out run --quiet --timing none").code == 0
    action = read_plan(Path("run")).actions[0].action
    ended = command("export run")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err == (
        f"llm3: error: action 1 {action}, transit: the plan has no times. Install them with pip install 'llm3[time]', "
        "and run again without --timing none.\n"
    )


def test_a_file_of_another_plan_is_refused_by_verify(command, solved):
    Path("other.csv").write_text("item\n")
    ended = command("verify run --trajectories other.csv")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err == "llm3: error: other.csv: there must be one column 'kind', and there are 0\n"


def test_what_was_altered_in_a_file_is_found(command, solved):
    assert command("export run").code == 0
    file = json.loads(Path("run.json").read_text())
    (first, *_) = (item["trajectory"] for item in file["items"] if item["kind"] == "trajectory")
    first["points"][1]["positions"][0] += 0.05
    Path("run.json").write_text(json.dumps(file))
    ended = command("verify run --trajectories run.json")
    assert ended.code == 1
    assert "the speed reaches" in ended.out or "the acceleration reaches" in ended.out


def test_in_a_process_of_its_own_the_name_of_the_file_is_all_that_is_printed(solved, surroundings, cwd):
    ended = run(llm3("export run --format npz"), cwd, surroundings)
    assert (ended.code, ended.out, ended.err) == (0, "run.npz\n", "")
