from __future__ import annotations

import dataclasses
import json
import math

import pytest
from docs_pages import page, table

from llm3.types import Defect, Verification

HEADING = "A second look at a plan"


def limits() -> dict[str, str]:
    return {row[0]: row[1] for row in table(page("verify"), HEADING, "what is allowed").rows}


@pytest.mark.pybullet
def test_the_limits_are_those_of_the_verifier():
    from llm3_boxpack import verification as boxpack
    from llm3_bullet.verification import deeds, gripping, states, sweep, way

    assert {what: text.partition(",")[0] for what, text in limits().items()} == {
        "depth of a contact": f"{sweep.CONTACT * 1000:g} mm",
        "from a finger to what it takes": f"{gripping.JUMP * 1000:g} mm",
        "from a cup to what it takes": f"{gripping.GRIP * 1000:g} mm",
        "from the closing direction to the way from a finger to what it takes": (
            f"{math.degrees(math.acos(gripping.SQUARELY)):.0f}°"
        ),
        "from a trajectory to the straight way between two waypoints, by joint": f"{way.ASIDE:g} rad or m",
        "from a box's centre to being over what it stands on": f"{states.OVERHANG * 1000:g} mm",
        "jump of what is taken": f"{gripping.JUMP * 1000:g} mm",
        "from where a box is let go to where the action says": f"{deeds.OFF_PLACE * 1000:g} mm",
        "from where a box is let go to where it comes to rest": f"{states.SETTLED * 1000:g} mm",
        "out of the basket": f"{boxpack.OUT_OF_BASKET * 1000:g} mm",
    }
    assert f"{deeds.OFF_ANGLE:g} rad" in limits()["from where a box is let go to where the action says"]
    assert f"come nearer by more than {sweep.STEP * 1000:g} mm from one look" in " ".join(page("verify").split())


def test_every_field_of_a_defect_is_named():
    told = page("verify").partition("A defect has the ")[2].partition("What does not apply")[0]
    for field in dataclasses.fields(Defect):
        assert f"`{field.name}`" in told


def test_the_object_of_verify_has_the_documented_fields(capsys, monkeypatch, corridor):
    from llm3.cli import verify_command
    from llm3.cli.main import main

    assert main(["--domain", "corridor", "--out", "o", "--quiet"]) == 0
    monkeypatch.setattr(verify_command, "verify", lambda problem, plan: Verification())
    capsys.readouterr()
    assert main(["verify", "o", "--json"]) == 0
    assert tuple(json.loads(capsys.readouterr().out)) == tuple(sorted(table(page("verify"), HEADING, "field").names))
