"""The paper's settings: three sets of boxes times three baskets, and where the boxes start.

The sizes are those of the published implementation's settings. Start poses are drawn from a seed.
"""

from __future__ import annotations

import numpy as np

from llm3.seeding import generator
from llm3_boxpack.instance import BasketSpec, BoxpackInstance, BoxSpec

Size = tuple[float, float, float]
_CUBE: Size = (0.07, 0.07, 0.07)
_POST: Size = (0.035, 0.035, 0.07)
_SLAB: Size = (0.035, 0.035, 0.04)
_BAR: Size = (0.105, 0.035, 0.07)

BOX_SETS: dict[str, dict[str, Size]] = {
    "easy": {"red_box": _POST, "blue_box": _CUBE, "green_box": _POST, "tan_box": _POST},
    "medium": {"cyan_box": _CUBE, "blue_box": _CUBE, "red_box": _SLAB, "yellow_box": _SLAB},
    "hard": {"red_box": _CUBE, "blue_box": _CUBE, "green_box": _BAR, "tan_box": _POST},
}
BASKETS: dict[str, BasketSpec] = {
    "small": BasketSpec((0.65, 0.0), (0.22, 0.21)),
    "medium": BasketSpec((0.70, 0.0), (0.32, 0.21)),
    "large": BasketSpec((0.75, 0.0), (0.42, 0.21)),
}
SETTINGS = tuple(f"{boxes}-{basket}" for boxes in BOX_SETS for basket in BASKETS)
START_X = (0.385, 0.395)
"""The boxes start in a row: x is drawn from here, in metres, …"""
START_Y = (-0.6, 0.6)
"""… and y from a lane of the box's own in here, in random order."""
LANE_GAP = 0.1
"""Free space in metres between the boxes of neighbouring lanes: room for two hands side by side."""


def generate(setting: str, seed: int) -> BoxpackInstance:
    """The instance of a setting, such as ``"hard-small"``, and a seed."""
    boxes, basket = setting.split("-")
    rng = generator("boxpack", setting, seed)
    sizes = BOX_SETS[boxes]
    lanes = np.linspace(*START_Y, len(sizes) + 1)
    placed: list[BoxSpec] = []
    for lane, name in enumerate(rng.permutation(list(sizes)).tolist()):
        size = sizes[name]
        margin = (size[1] + LANE_GAP) / 2
        x, y = rng.uniform(*START_X), rng.uniform(lanes[lane] + margin, lanes[lane + 1] - margin)
        placed.append(BoxSpec(name, size, (round(float(x), 3), round(float(y), 3))))
    placed.sort(key=lambda box: list(sizes).index(box.name))
    return BoxpackInstance(BASKETS[basket], tuple(placed))
