"""The two primitive actions, with the paper's ranges."""

from __future__ import annotations

from llm3.types import ActionSchema, Parameter, Sketch
from llm3_boxpack.instance import BoxpackInstance

PICK = ActionSchema("pick", ("box",), (), "pick up the box from above")
PLACE = ActionSchema(
    "place",
    ("box",),
    (Parameter("x", 0.0, 1.0, "m"), Parameter("y", -1.0, 1.0, "m"), Parameter("theta", -3.14, 3.14, "rad")),
    "put down the held box with its centre at (x, y), turned by theta about the vertical",
)


def pieces(instance: BoxpackInstance) -> tuple[tuple[Sketch, ...], ...]:
    """For each box, and for each thing that is in the way, a pick and a place."""
    return tuple((Sketch(PICK.name, (thing.name,)), Sketch(PLACE.name, (thing.name,))) for thing in instance.things)


def skeleton(instance: BoxpackInstance) -> tuple[Sketch, ...] | None:
    """Pick and place each box, in the order in which they are listed; None where another order may be needed.

    That is so between walls, where some boxes have to come before others, and where things may have to be moved first.
    """
    if instance.clutter or instance.basket.walls:
        return None
    return tuple(Sketch(action.name, (box.name,)) for box in instance.boxes for action in (PICK, PLACE))
