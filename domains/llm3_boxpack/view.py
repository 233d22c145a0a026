"""What a prompt tells of boxes, basket and hand, in millimetres, for a stand-in that reckons with them."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin

from llm3.types import Context, Entity
from llm3_boxpack.families.hand import Hand
from llm3_boxpack.families.standing import Standing
from llm3_boxpack.families.tray import Tray

ON_FLOOR = 5.0
"""What stands higher than this stands in the tray, in millimetres."""


@dataclass(frozen=True)
class View:
    """Everything that matters, but for colours."""

    tray: Tray
    boxes: tuple[Standing, ...]
    """What is still to be packed, where it stands."""
    packed: tuple[Standing, ...]
    """What is in the tray, and belongs there."""
    things: tuple[Standing, ...]
    """What is only in the way."""
    hand: Hand


def view_of(context: Context) -> View:
    """Read a prompt that tells of the hand."""
    state = {entity.name: entity for entity in context.state}
    basket, hand = state["basket"], state["hand"]
    (x0, x1), (y0, y1) = _numbers(basket, "x range"), _numbers(basket, "y range")
    tray = Tray((x0, y0), (x1, y1), *_numbers(basket, "wall height") if "wall height" in basket.properties else (0.0,))
    standing = {name: _standing(state[name]) for name in context.objects if "theta" in state[name].properties}
    unwanted = {name for name in standing if state[name].properties.get("to be packed") == "no"}
    inside = {name for name, box in standing.items() if box.bottom > ON_FLOOR}
    heights = {_numbers(state[name], "size")[2]: name for name in standing}

    def of_height(height: float) -> tuple[float, float]:
        nearest = state[heights[min(heights, key=lambda known: abs(known - height))]]
        return _numbers(nearest, "fingertips")[0], _numbers(nearest, "palm")[0]

    return View(
        tray,
        tuple(box for name, box in standing.items() if name not in unwanted | inside),
        tuple(box for name, box in standing.items() if name in inside - unwanted),
        tuple(box for name, box in standing.items() if name in unwanted),
        Hand(
            _numbers(hand, "fingers reach beyond a face")[0],
            _numbers(hand, "finger width")[0],
            (_numbers(hand, "palm length")[0], _numbers(hand, "palm width")[0]),
            of_height,
        ),
    )


def _standing(entity: Entity) -> Standing:
    """A box; one that is turned otherwise than by quarters is taken for as large as the space around it."""
    x, y, z = _numbers(entity, "position")
    along, across, height = _numbers(entity, "size")
    theta = entity.properties["theta"]
    turn = float(theta) if isinstance(theta, float | int) else 0.0
    c, s = abs(cos(turn)), abs(sin(turn))
    dx, dy = round(c * along + s * across), round(s * along + c * across)
    return Standing(entity.name, x, y, dx, dy, z + height / 2, z - height / 2)


def _numbers(entity: Entity, name: str) -> tuple[float, ...]:
    """A property in metres as millimetres."""
    value = entity.properties[name]
    values = value if isinstance(value, tuple) else (value,)
    return tuple(round(1000 * float(v), 1) for v in values)
