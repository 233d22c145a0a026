"""What things look like in the window and in pictures."""

from __future__ import annotations

COLORS: dict[str, tuple[float, float, float]] = {
    "carrot": (0.93, 0.49, 0.13),
    "leek": (0.60, 0.75, 0.38),
    "cucumber": (0.20, 0.50, 0.25),
    "aubergine": (0.36, 0.20, 0.45),
    "corn": (0.95, 0.80, 0.25),
    "bread": (0.72, 0.50, 0.28),
    "potato": (0.82, 0.70, 0.50),
    "tomato": (0.83, 0.18, 0.15),
    "oil_bottle": (0.55, 0.60, 0.20),
    "milk_carton": (0.95, 0.95, 0.97),
    "jam_jar": (0.60, 0.10, 0.25),
    "tea_tin": (0.20, 0.55, 0.60),
    "salt_box": (0.35, 0.50, 0.80),
    "stove": (0.20, 0.20, 0.22),
    "sink_front": (0.70, 0.72, 0.75),
    "sink_back": (0.70, 0.72, 0.75),
    "sink_right": (0.70, 0.72, 0.75),
    "sink_left": (0.70, 0.72, 0.75),
}
"""Of what the settings have, from 0 to 1."""
