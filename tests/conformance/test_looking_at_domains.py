"""How far the kit looks at a domain: what it remarks on, where it stops, and what it looks at first."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from depot import Depot, a_depot
from yard import Yard, a_yard

import llm3_birrt.plugin
from llm3 import Env, Registry
from llm3.testing import check_domain
from llm3.testing.conformance.domain import examine_domain
from llm3.types import ActionSchema, Failure, FailureKind, GoalStatus, NoMotion, Parameter, Pose, Transition

TAKE, STOW, CHARGE = Depot.schemas


@pytest.fixture(scope="module")
def registry() -> Registry:
    found = Registry()
    found.register(llm3_birrt.plugin, "birrt (test)")
    return found


def remarks(registry, domain, seeds=(0,)):
    return examine_domain(domain, registry, seeds=seeds).remarks


def pushing(self, state, action, motion):
    """Charging shoves a parcel aside."""
    after = Depot.apply(self, state, action, motion).state
    if action.name != "charge" or "parcel_0" not in after.poses:
        return Transition(after)
    x, y, z = after.poses["parcel_0"].position
    return Transition(replace(after, poses={**after.poses, "parcel_0": Pose((x + 0.05, y, z))}))


def counted(seconds=0.0, **parts):
    """A depot whose prepare takes so long by a clock of its own; and that clock, and how often it was asked."""
    asked = []

    def prepare(self, state, action, rng):
        asked.append(action)
        return Depot.prepare(self, state, action, rng)

    return a_depot(prepare=prepare, **parts), asked, lambda: seconds * len(asked)


def test_what_is_usual_is_no_remark(registry):
    assert remarks(registry, a_depot()) == ()


def test_a_goal_that_is_never_reached_is_told_with_the_worlds(registry):
    domain = a_depot(goal=lambda self, state: GoalStatus(False, ("a parcel is missing",)), stand_in=lambda self: None)
    assert remarks(registry, domain, (0, 1)) == (
        "In no world was the goal reached, so whether it can be is not known: small, seed 0; small, seed 1.",
    )


def test_a_parameter_that_changes_nothing_is_a_remark(registry):
    charge = replace(CHARGE, parameters=(Parameter("power", 1.0, 5.0, "kW"),))
    never_refused, idle = remarks(registry, a_depot(schemas=(TAKE, STOW, charge)))
    assert never_refused.endswith("'charge' actions that were tried was refused.")
    assert idle == "Parameter 'power' of 'charge' changes nothing in what becomes of the actions that were tried."


def test_what_moves_without_a_note_is_a_remark(registry):
    assert remarks(registry, a_depot(apply=pushing)) == (
        "charge([], {}) moves 'parcel_0', too, by 0.05 m, and no note tells of it.",
    )


def test_a_slow_domain_is_asked_less(registry):
    quick, often, clock = counted(0.01)
    assert check_domain(quick, seeds=(0,), registry=registry, clock=clock) == ()
    slow, seldom, clock = counted(0.5)
    assert check_domain(slow, seeds=(0,), registry=registry, clock=clock) == ()
    assert 2 * len(seldom) < len(often)


def test_many_objects_at_many_places_are_bounded(registry):
    swap = ActionSchema("swap", ("one", "two", "three", "four"), (), "swap them all")
    domain, asked, clock = counted(schemas=(TAKE, STOW, CHARGE, swap), refusal=swapping, parcels=20)
    check_domain(domain, seeds=(0,), registry=registry, clock=clock)
    assert len({name for action in asked if action.name == "swap" for name in action.objects}) == 22
    assert len(asked) < 2000


def swapping(self, state, action):
    return "nothing can be swapped" if action.name == "swap" else Depot.refusal(self, state, action)


def test_parameters_are_tried_at_both_ends_of_their_ranges(registry):
    domain, asked, clock = counted()
    check_domain(domain, seeds=(0,), registry=registry, clock=clock)
    assert {0.0, 0.5} <= {action.params["depth"] for action in asked if action.name == "stow"}


def test_what_is_held_is_put_down_among_forty_objects(registry):
    found = remarks(registry, a_depot(parcels=40, stand_in=lambda self: None))
    assert not any("'stow' actions that were tried could be carried out" in remark for remark in found)


def motionless(self, state, action, rng):
    """All actions need a motion, whose test does not answer as it should."""
    answer = Yard.prepare(self, state, action, rng)
    if isinstance(answer, NoMotion):
        return Failure(FailureKind.PRECONDITION, "the bell hangs too high")
    return replace(answer, valid=lambda Q: bool(np.all(Q))) if not isinstance(answer, Failure) else answer


def test_a_mask_of_a_wrong_shape_is_told_before_all_else(registry):
    first, *_ = check_domain(a_yard(prepare=motionless), seeds=(0,), registry=registry)
    assert first.rule == "validity is one answer a configuration"


def test_an_abstract_property_that_is_set_is_told_with_what_to_do(registry):
    parts = {name: getattr(Depot, name) for name in vars(Depot) if name not in ("objects", "__init__")}
    env = type("Bare", (Env,), {**{k: v for k, v in parts.items() if not k.startswith("__")}, "__init__": setting})
    (complaint,) = check_domain(
        a_depot(make=lambda self, instance, options: env(instance)), seeds=(0,), registry=registry
    )
    assert "Can't instantiate abstract class Bare" in complaint.text
    assert complaint.cause == (
        "What varies by instance is a @property of the Env that answers it: it cannot be set in __init__."
    )


def setting(self, instance):
    self.instance, self.objects = instance, ("parcel_0",)
