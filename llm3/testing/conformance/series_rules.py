"""Rules for all the worlds of a domain that were looked at, together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.look import unlike
from llm3.testing.conformance.world import World


def another_instance_gives_another_world(worlds: Sequence[World]) -> Iterator[Fault]:
    """Somewhere among worlds of different instances, what they tell of themselves differs."""
    looks = [(world, world.look) for world in worlds if world.look is not None]
    unequal = [(world, look) for world, look in looks if world.instance != looks[0][0].instance]
    if unequal and not any(unlike(looks[0][1], look) for _, look in unequal):
        yield Fault(
            f"{looks[0][0].where} and {unequal[0][0].where} are different instances, and their worlds are alike: "
            "task, objects, state and description.",
            "The Env does not look at its instance: reset and task answer what stands in it.",
        )


def the_stand_in_reaches_the_goal(worlds: Sequence[World]) -> Iterator[Fault]:
    """A stand-in reaches the goal in some of the worlds that are looked at, unless a solution is known for one."""
    led = [world for world in worlds if world.led is not None]
    if any(world.witness is not None for world in led):
        return  # the goal can be reached, and rules of thumb need not find out how
    if led and not any(world.led for world in led):
        unmet = next((world.unmet for world in led if world.unmet), ())
        yield Fault(
            f"the stand-in reaches the goal in none of {len(led)} worlds"
            f"{f', and in the first one this is missing: {unmet[0]}' if unmet else ''}.",
            "Its plans are wrong, or the goal asks for more than actions can do, such as a place that none reaches.",
        )


RULES = (another_instance_gives_another_world,)
LAST_RULES = (the_stand_in_reaches_the_goal,)
"""Looked at where nothing else is wrong that might be the reason."""
