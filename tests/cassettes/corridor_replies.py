"""What a model might write about the corridor of seed 7."""

import json

BLOCKED = "go([], {'x': 1.0, 'y': 0.95})"
HALF_WAY = "go([], {'x': 0.5, 'y': 0.5})"
ARRIVED = "go([], {'x': 1.9, 'y': 0.5})"


def reply(*plan: str) -> str:
    """What a model would write."""
    return json.dumps({"Reasoning": "", "Full Plan": list(plan)})


SCRIPT = (reply(BLOCKED), "no plan", reply(HALF_WAY), reply(HALF_WAY, ARRIVED))
"""Replies to four prompts, of which the last solves the corridor."""
