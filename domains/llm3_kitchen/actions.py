"""The primitive actions."""

from __future__ import annotations

from llm3.types import ActionSchema, Parameter

PICK = ActionSchema("pick", ("object",), (), "pick up the object from above")
PLACE = ActionSchema(
    "place",
    ("object", "place"),
    (Parameter("x", -0.8, 0.8, "m"), Parameter("y", -0.8, 0.8, "m"), Parameter("theta", -3.14, 3.14, "rad")),
    "put down the held object with its centre at (x, y), turned by theta about the vertical, all of it in the place",
)
WASH = ActionSchema("wash", ("food",), (), "wash the food, which stands in a sink; the gripper is empty")
HEAT = ActionSchema(
    "heat", ("food",), (), "heat the food, which stands on a stove and is washed already; the gripper is empty"
)
