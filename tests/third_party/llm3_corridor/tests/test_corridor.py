from llm3_corridor import CorridorEnv, CorridorInstance

from llm3 import Prompt, Registry, solve
from llm3.testing import ScriptedLLM


def test_a_failed_plan_is_corrected():
    registry = Registry.discover()
    model = ScriptedLLM(
        ["{\"Full Plan\": [\"go([], {'x': 1.0, 'y': 0.9})\"]}", "{\"Full Plan\": [\"go([], {'x': 1.9, 'y': 0.5})\"]}"]
    )
    result = solve(
        CorridorEnv(CorridorInstance(gap=0.3)),
        backend=model,
        planner=registry.planner("birrt"),
        feedback=registry.feedback("categorized"),
        prompt=Prompt(registry.strategy("backtrack")),
    )
    assert result.solved
    assert result.stats.llm_calls == 2
    assert "in collision with wall" in model.prompts[1]
