"""The paper's task, recorded and repeated: the same joint paths and times to the last digit."""

from __future__ import annotations

import pytest

from llm3.records import read_events, read_plan

pytestmark = [pytest.mark.slow, pytest.mark.pybullet]


@pytest.mark.parametrize(
    "flags",
    [
        "--setting hard-medium --seed 2",
        "--setting hard-small --seed 1 --strategy sample-params --llm random --max-llm-calls 5",
        "--setting easy-large --seed 3 --feedback binary -D robot=iiwa --timing none",
    ],
)
def test_a_recorded_run_is_repeated_to_the_byte(command, cwd, flags):
    code = command(f"--domain boxpack {flags} --out first --record tape.jsonl --quiet").code
    assert code in (0, 1)
    method = " ".join(word for word in flags.split("--llm random") if word)
    for name, line in (
        ("again", "--llm replay:first"),
        ("taped", f"--domain boxpack {method} --llm replay:tape.jsonl"),
    ):
        ended = command(f"{line} --out {name}")
        assert ended.code == code
        assert ended.err.splitlines()[-1].startswith("the run repeated its recording: ")
        first, second = cwd / "first/plan.json", cwd / name / "plan.json"
        assert first.exists() == second.exists() == (code == 0)
        assert code == 1 or first.read_bytes() == second.read_bytes()


def test_the_events_tell_the_plan_with_its_times(command, cwd):
    command("--domain boxpack --seed 2 --timing toppra --out first --quiet")
    *_, last = read_events(cwd / "first")
    assert last.event.result.plan == read_plan(cwd / "first").actions
    assert last.event.result.plan[0].motion.duration > 0


def test_a_robot_of_ones_own_is_in_the_record(command, cwd):
    from llm3.jsonio import pretty
    from llm3_bullet.robots.panda import panda

    (cwd / "mine.json").write_text(pretty(panda()), encoding="utf-8")
    assert command("--domain boxpack -D robot=mine.json --out first --quiet").code == 0
    (cwd / "mine.json").unlink()
    assert command("--llm replay:first --out again --quiet").code == 0
    assert (cwd / "again/plan.json").read_bytes() == (cwd / "first/plan.json").read_bytes()
