"""Rules for what a domain may offer besides."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from llm3.interfaces import PlanVerifier
from llm3.parsing import parse_reply
from llm3.solve import context_of
from llm3.testing.conformance.inspection import Fault
from llm3.testing.conformance.regions import region_faults
from llm3.testing.conformance.twin_rules import departures
from llm3.testing.conformance.world import World
from llm3.types import Proposal, Rejected, Shape, Verification


def regions_are_parts_of_the_ranges(world: World) -> Iterator[Fault]:
    """Each region goes by an action, its objects and a parameter that there are, and lies within its range."""
    found = world.domain.regions(world.instance)
    if found is not None:
        yield from region_faults(world.env, found)


def the_stand_in_answers_as_a_model_should(world: World) -> Iterator[Fault]:
    """The stand-in's reply is read without a fault, and the same generator gives the same reply."""
    stand_in = world.domain.stand_in()
    if stand_in is None:
        return
    context = context_of(world.env, world.start)
    reply, again = (stand_in(context, np.random.default_rng(0)) for _ in range(2))
    if reply != again:
        yield Fault(
            "the stand-in answers differently with the same generator.", "It must draw from its generator alone."
        )
    read = parse_reply(reply, world.env.schemas, world.env.objects)
    form = 'It writes {"Reasoning": "…", "Full Plan": [str(action), …]} as JSON.'
    if not isinstance(read, Proposal):
        yield Fault(f"no plan can be read from the stand-in's reply: {read.detail}.", form)
        return
    for item in read.actions:
        if isinstance(item, Rejected):
            yield Fault(f"the stand-in proposes {item}: {item.failure.detail}.", form)


def the_view_from_above_is_drawn_alike(world: World) -> Iterator[Fault]:
    """top_view answers shapes of different names, the same for the same state."""
    states = [world.start, *(trial.transition.state for trial in world.applied[:6] if trial.transition)]
    for state in states:
        shapes = world.domain.top_view(world.instance, world.options, state)
        if shapes is None:
            return
        if not isinstance(shapes, tuple) or not all(isinstance(shape, Shape) for shape in shapes):
            yield Fault(f"top_view must answer a tuple of Shape or None, not {shapes!r}.", "A tuple needs a comma.")
            return
        names = [shape.name for shape in shapes]
        if len(set(names)) < len(names):
            yield Fault(f"top_view draws two things of one name: {', '.join(names)}.", "Figures go by the names.")
        if shapes != world.domain.top_view(world.instance, world.options, state):
            yield Fault("top_view draws one state in two ways.", "It must look at nothing but its arguments.")


def the_verifier_tells_good_plans_from_bad(world: World) -> Iterator[Fault]:
    """An honest plan that reaches the goal is sound; one that does nothing, or begins in its middle, is not."""
    verifier = world.domain.verifier(world.instance, world.options)
    if verifier is None:
        return
    if not isinstance(verifier, PlanVerifier):
        yield Fault(f"verifier must answer a PlanVerifier or None, not {verifier!r}.", "It answers an instance.")
        return
    world.verified = True
    nothing = verifier.verify(world.start, ())
    if not isinstance(nothing, Verification) or (nothing.sound and not world.env.goal(world.start).achieved):
        yield Fault("the verifier finds a plan sound that does nothing.", "It must ask at the end for the goal.")
    if world.result is not None:
        for defect in verifier.verify(world.start, world.result.plan).defects:
            yield Fault(
                f"the verifier refuses a plan that the world carried out: {defect}.",
                "The world and the verifier do not agree on what is there, on distances, or on the goal.",
            )
            return
        *before, last = world.result.plan
        elsewhere = bool(before) and before[-1].state.configuration != world.start.configuration
        if elsewhere and verifier.verify(world.start, (last,)).sound:
            yield Fault(
                "the verifier finds a plan sound of which only the last action is left.",
                "It must see that each motion begins where the robot is, and ask for the goal of what it has played "
                "itself: what the plan says of states is not to be believed.",
            )


def a_remade_world_is_like_a_new_one(world: World) -> Iterator[Fault]:
    """Nothing but the time that it takes tells a world of remake from one of make."""
    if world.spare is None:
        return
    remade = world.domain.remake(world.spare, world.instance, world.options)
    if remade is None:
        return
    world.remade = remade
    cause = "The old world leaves something behind: what remake takes over must be a cache of the State."
    yield from departures(world.env, remade, world.again(world.trials), cause)


RULES = (
    the_stand_in_answers_as_a_model_should,
    the_view_from_above_is_drawn_alike,
)
