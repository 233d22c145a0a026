"""What a model is told of the palm: the figures of the robot in use."""

from __future__ import annotations

from llm3_kitchen.domain import Kitchen

PALM = (
    "Then the hand moves straight up. Above the fingers is the palm. Seen from above, it reaches 0.105 m to either "
    "side of the object's middle in the direction in which the fingers close, and 0.033 m across that. Its underside "
    "is 0.051 m above the object's middle (for an object lower than 0.048 m, 0.039 m and a quarter of the object's "
    "height), but at least 0.005 m above the object; the tips of the fingers are 0.048 m below that. What is higher "
    "than the underside must not be in the way of the palm, and what is higher than the tips not in that of the "
    "fingers."
)


def test_a_model_is_told_how_far_the_palm_and_the_fingers_reach(make):
    assert make(Kitchen().instance("kitchen-3", 0)).task.endswith(PALM)


def test_a_cup_has_no_palm():
    domain = Kitchen()
    env = domain.make(domain.instance("kitchen-3", 0), {"robot": "iiwa"})
    assert env.task.endswith("When it has taken an object, or let go of it, it moves straight up.")
    env.close()
