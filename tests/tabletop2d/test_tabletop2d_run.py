"""Whole runs: a scripted model that corrects itself, and the conformance kit."""

from __future__ import annotations

import json

import pytest
from plane_world import DOMAIN, box, disc, pick, place, problem, push

from llm3 import Prompt, Registry, solve
from llm3.testing import ScriptedLLM, check_domain
from llm3_tabletop2d.env import TabletopEnv


def reply(*plan) -> str:
    return json.dumps({"Reasoning": "because", "Full Plan": [str(action) for action in plan]})


@pytest.mark.parametrize("planner", ["birrt", "ompl-rrtconnect"])
def test_a_model_reads_why_its_plan_failed_and_corrects_it(planner):
    registry = Registry.discover()
    env = TabletopEnv(problem(disc("red_disc", 0.3, 0.4), box("grey_box", 0.7, 0.4)), 0.03)
    model = ScriptedLLM(
        [
            reply(push("red_disc", 1.05, 0.4)),
            reply(pick("red_disc"), place("red_disc", 0.65, 0.4)),
            reply(pick("red_disc"), place("red_disc", 1.05, 0.4)),
        ]
    )
    result = solve(
        env,
        backend=model,
        planner=registry.planner(planner),
        feedback=registry.feedback("categorized"),
        prompt=Prompt(registry.strategy("backtrack")),
    )
    assert result.solved
    assert result.stats.llm_calls == 3
    assert (
        "in collision with grey_box (touched by the pushed red_disc). The push is stopped after 0.3" in model.prompts[1]
    )
    assert "in collision with grey_box (touched by the held red_disc)." in model.prompts[2]


@pytest.mark.parametrize(
    "setting", [pytest.param(s, marks=[] if s == "push" else pytest.mark.slow) for s in DOMAIN.settings]
)
def test_the_conformance_kit_has_no_complaint(setting):
    assert check_domain(DOMAIN, setting=setting, seeds=(0,)) == ()
