"""The three primitive actions."""

from __future__ import annotations

from llm3.types import ActionSchema, Parameter

PICK = ActionSchema("pick", ("block",), (), "pick up the block from above")
PLACE = ActionSchema(
    "place",
    ("block",),
    (Parameter("x", 0.0, 1.0, "m"), Parameter("y", -1.0, 1.0, "m"), Parameter("theta", -3.14, 3.14, "rad")),
    "put down the held block on the table with its centre at (x, y), turned by theta about the vertical",
)
STACK = ActionSchema(
    "stack",
    ("block", "other_block"),
    (),
    "put down the held block on the middle of the other block, with its sides along those of the other block",
)
