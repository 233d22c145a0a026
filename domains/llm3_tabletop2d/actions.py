"""The three primitive actions, and a sequence of them for runs whose sequence is given."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi

from llm3.types import ActionSchema, Parameter, Sketch
from llm3_tabletop2d.instance import ObjectSpec, Pair, TabletopInstance

PICK, PLACE, PUSH = "pick", "place", "push"
LARGEST_CARRIED = 0.15
"""An object with a longer side than this, in metres, is too large to be carried."""
MAX_VELOCITY, MAX_ACCELERATION = 0.5, 1.0
"""Of the robot along x and along y, in m/s and m/s²."""


def schemas(room: Pair) -> tuple[ActionSchema, ...]:
    """What the robot can do in a room with these side lengths, in metres."""
    spot = Parameter("x", 0.0, room[0], "m"), Parameter("y", 0.0, room[1], "m")
    angle = Parameter("angle", -round(pi, 2), round(pi, 2), "rad")
    return (
        ActionSchema(
            PICK,
            ("object",),
            (angle,),
            "go to the side of the object that lies in the direction of the angle, seen from its centre (0 is the "
            "positive x direction, 1.57 the positive y direction), and take hold of it there",
        ),
        ActionSchema(PLACE, ("object",), spot, "bring the held object to where its centre is at (x, y), and let go"),
        ActionSchema(
            PUSH,
            ("object",),
            spot,
            "go behind the object and push it along a straight line until its centre is at (x, y)",
        ),
    )


def too_large(item: ObjectSpec) -> bool:
    """Whether an object can only be pushed."""
    return max(item.size) > LARGEST_CARRIED


def skeleton(instance: TabletopInstance) -> tuple[Sketch, ...]:
    """What has no goal is taken away first; then each object goes where it belongs.

    Where the first object to be moved belongs in a place that is taken, it is pushed aside before all others.
    """
    belongs = [item for item in instance.objects if instance.region_of(item.name)]
    others = [item for item in instance.objects if not instance.region_of(item.name)]
    sketches = [sketch for item in others for sketch in _bring(item)]
    aside = belongs[:1] if all(is_taken(instance, item) for item in belongs) else []
    sketches += [Sketch(PUSH, (item.name,)) for item in aside]
    for item in (*belongs[len(aside) :], *aside):
        sketches += _bring(item)
    return tuple(sketches)


def _bring(item: ObjectSpec) -> Iterator[Sketch]:
    for name in (PUSH,) if too_large(item) else (PICK, PLACE):
        yield Sketch(name, (item.name,))


def is_taken(instance: TabletopInstance, item: ObjectSpec) -> bool:
    """Whether another object starts where this one belongs."""
    region = instance.region_of(item.name)
    return region is not None and any(
        all(low <= p <= high for p, (low, high) in zip(other.position, region.ranges, strict=True))
        for other in instance.objects
        if other is not item
    )
