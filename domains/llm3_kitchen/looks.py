"""What the kitchen looks like in pictures."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from llm3.types import Camera, Color, Pose
from llm3_bullet.scene import Box
from llm3_kitchen.instance import PlaceSpec

CAMERA = Camera(target=(0.24, 0.0, 0.17), distance=1.75, yaw=90.0, pitch=-48.0)
MARKS: dict[str, Color] = {
    "store": (0.80, 0.74, 0.64),
    "sink": (0.55, 0.62, 0.68),
    "worktop": (0.78, 0.80, 0.76),
    "serving": (0.97, 0.96, 0.92),
}
"""By their kind, the places whose area is marked on the table."""
COLORS: dict[str, Color] = {
    "carrot": (0.93, 0.49, 0.13),
    "leek": (0.60, 0.75, 0.38),
    "cucumber": (0.20, 0.50, 0.25),
    "aubergine": (0.36, 0.20, 0.45),
    "corn": (0.95, 0.80, 0.25),
    "bread": (0.72, 0.50, 0.28),
    "potato": (0.82, 0.70, 0.50),
    "tomato": (0.83, 0.18, 0.15),
    "asparagus": (0.45, 0.65, 0.25),
    "parsnip": (0.93, 0.88, 0.70),
    "zucchini": (0.30, 0.42, 0.15),
    "pineapple": (0.85, 0.62, 0.15),
    "celery": (0.70, 0.85, 0.45),
    "squash": (0.95, 0.65, 0.35),
    "fennel": (0.85, 0.92, 0.78),
    "cauliflower": (0.97, 0.95, 0.85),
    "pepper": (0.80, 0.15, 0.10),
    "oil_bottle": (0.55, 0.60, 0.20),
    "milk_carton": (0.95, 0.95, 0.97),
    "jam_jar": (0.60, 0.10, 0.25),
    "tea_tin": (0.20, 0.55, 0.60),
    "salt_box": (0.35, 0.50, 0.80),
    "vinegar_bottle": (0.45, 0.25, 0.15),
    "juice_carton": (0.95, 0.55, 0.20),
    "rice_box": (0.65, 0.75, 0.90),
    "coffee_tin": (0.35, 0.22, 0.15),
    "sugar_box": (0.90, 0.85, 0.95),
    "flour_bag": (0.85, 0.80, 0.70),
    "mustard_jar": (0.80, 0.68, 0.10),
    "honey_jar": (0.88, 0.55, 0.05),
    "spice_box": (0.60, 0.30, 0.55),
    "stove": (0.20, 0.20, 0.22),
    "sink_front": (0.70, 0.72, 0.75),
    "sink_back": (0.70, 0.72, 0.75),
    "sink_right": (0.70, 0.72, 0.75),
    "sink_left": (0.70, 0.72, 0.75),
}
"""Of what the settings have, from 0 to 1."""


def marks(places: Iterable[PlaceSpec]) -> Iterator[tuple[Box, Color]]:
    """Thin boxes on the table where places are, and their colours."""
    for place in places:
        if place.kind in MARKS:
            yield (
                Box(f"{place.name}_mark", (*place.size, 0.002), Pose((*place.center, 0.0)), fixed=True),
                MARKS[place.kind],
            )
