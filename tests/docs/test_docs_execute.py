from __future__ import annotations

import dataclasses
import json

import pytest
from docs_pages import page, table, tables

from llm3.cli.main import build_parser
from llm3.types import PACE, Executed, ExecutionReport, Noise, PoseError, Slip


@pytest.mark.pybullet
def test_the_figures_are_those_of_the_physics():
    from llm3_bullet.execution import ExecutionSettings, slips

    physics = ExecutionSettings()
    shown = {row[0]: row[1] for row in table(page("execute"), "The physics").rows}
    assert shown == {
        "time step of the simulation": f"1/{1 / physics.boxes.time_step:.0f} s",
        "weight of a box": f"{physics.boxes.density:g} kg/m³, wood",
        "friction of a box, the table and the furniture": f"{physics.boxes.friction:g} each",
        "friction of a finger": f"{physics.pad_friction:g}",
        "push of a finger": f"{physics.grip_force:g} N at most",
        "speed of a finger": f"{physics.finger_speed:g} m/s at most",
        "from a cup to the face that it takes": (
            f"{physics.cup_reach * 1000:g} mm, {physics.cup_tilt:g} rad, and the whole rim on the face"
        ),
        "pull of a cup": f"{physics.suction / 1000:g} kPa times the area of its rim at most",
        "wait for things to come to rest": f"{physics.longest_wait:g} s at most",
    }
    text = " ".join(page("execute").split())
    assert f"or {physics.default_effort:g} N m." in text
    assert f"its fastest joint moves at {PACE:g} rad or {PACE:g} m a second" in text
    assert f"off by no more than {slips.FAR * 1000:g} mm and 1 degree counts as planned" in text


def test_every_kind_of_noise_has_a_flag():
    flags = {row[0].strip("`") for row in table(page("execute"), "Noise").rows}
    assert flags == {flag for flag in build_parser("execute")._option_string_actions if flag.endswith("-noise")}
    assert len(flags) == len(dataclasses.fields(Noise))


def test_the_object_has_the_documented_fields(capsys, monkeypatch, corridor):
    from contextlib import nullcontext

    from llm3.cli import execute_command
    from llm3.cli.main import main
    from llm3.types import Action, Execution, GoalStatus, State

    done = Executed(Action("go"), 1.0, slips=(Slip("it slipped"),))
    execution = Execution(State(), State(), (done,))
    report = ExecutionReport(execution, GoalStatus(True), {"cup": PoseError(0.1, 0.2)})
    assert main(["--domain", "corridor", "--out", "o", "--quiet"]) == 0
    monkeypatch.setattr(execute_command, "open_executor", lambda problem, noise: nullcontext())
    monkeypatch.setattr(execute_command, "execute", lambda *_: report)
    capsys.readouterr()
    assert main(["execute", "o", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    (shown,) = told["executions"]
    whole, one, action = (set(found.names) for found in tables(page("execute")) if found.heading == "As JSON")
    assert (set(told), set(shown), set(shown["actions"][0])) == (whole, one, action)
    text = page("execute")
    for kind in (Noise, PoseError, Slip, GoalStatus):
        for field in dataclasses.fields(kind):
            assert f"`{field.name}`" in text
