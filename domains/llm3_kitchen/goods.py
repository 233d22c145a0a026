"""What there is to cook, and what stands about: names and sizes x, y, z in metres."""

from __future__ import annotations

from llm3_bullet.scene import Size

FOODS: dict[str, Size] = {
    "carrot": (0.12, 0.03, 0.03),
    "leek": (0.15, 0.035, 0.035),
    "cucumber": (0.13, 0.04, 0.04),
    "aubergine": (0.11, 0.055, 0.055),
    "corn": (0.12, 0.045, 0.045),
    "bread": (0.10, 0.065, 0.06),
    "potato": (0.05, 0.05, 0.045),
    "tomato": (0.045, 0.045, 0.04),
}
CLUTTER: dict[str, Size] = {
    "oil_bottle": (0.045, 0.045, 0.16),
    "milk_carton": (0.06, 0.06, 0.14),
    "jam_jar": (0.055, 0.055, 0.11),
    "tea_tin": (0.065, 0.045, 0.13),
    "salt_box": (0.05, 0.04, 0.12),
}
MORE_FOODS: dict[str, Size] = {
    "asparagus": (0.13, 0.035, 0.03),
    "parsnip": (0.12, 0.035, 0.035),
    "zucchini": (0.125, 0.045, 0.04),
}
"""Low, like those before."""
TALL_FOODS: dict[str, Size] = {
    "pineapple": (0.07, 0.06, 0.12),
    "celery": (0.06, 0.045, 0.115),
    "squash": (0.065, 0.055, 0.11),
    "fennel": (0.06, 0.05, 0.1),
    "cauliflower": (0.07, 0.065, 0.095),
    "pepper": (0.06, 0.055, 0.09),
}
"""Fingers that hold these by their upper part pass above low food, and the hand that holds low food hits these."""
MORE_CLUTTER: dict[str, Size] = {
    "vinegar_bottle": (0.05, 0.045, 0.16),
    "juice_carton": (0.065, 0.055, 0.155),
    "rice_box": (0.07, 0.04, 0.15),
    "coffee_tin": (0.07, 0.055, 0.14),
    "sugar_box": (0.065, 0.05, 0.135),
    "flour_bag": (0.07, 0.05, 0.125),
    "mustard_jar": (0.055, 0.05, 0.115),
    "honey_jar": (0.06, 0.05, 0.11),
    "spice_box": (0.06, 0.04, 0.105),
}
"""None of it is square, so there is no doubt which two sides the fingers take."""
