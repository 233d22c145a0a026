"""Yards that say something wrong: of themselves, to a model, of their states, or of what they offer besides."""

from __future__ import annotations

import random
from dataclasses import dataclass, replace

import numpy as np
from planted import Planted
from yard import Yard, YardInstance, YardVerifier, a_yard, tidy, with_state

from llm3 import Joint, Option
from llm3.interfaces import PlanVerifier
from llm3.types import Action, ActionSchema, Defect, Entity, GoalStatus, Parameter, Shape, Sketch, Verification

TAKE, PUT, RING = Yard.schemas


@dataclass(frozen=True)
class Unwritable:
    gap: float
    cup: complex = 1j


def unseeded(self, setting, seed):
    return YardInstance((round(random.uniform(0.3, 0.7), 4), 0.5), 0.5)


class Gullible(PlanVerifier):
    def verify(self, start, actions):
        return Verification()


class Believing(PlanVerifier):
    def __init__(self, instance):
        self.env = Yard(instance)

    def verify(self, start, actions):
        last = actions[-1].state if actions else start
        return Verification(tuple(map(Defect, self.env.goal(last).unmet)))


class Strict(PlanVerifier):
    def verify(self, start, actions):
        return YardVerifier(Yard(YardInstance((0.5, 0.5), 0.5))).verify(start, ())


def remade_with_another_gap(self, env, instance, options):
    env.instance = replace(instance, gap=round(instance.gap + 0.1, 1))
    return env


def own_chance():
    rng = np.random.default_rng(0)
    return lambda self: lambda context, _: tidy(context, rng)


OF_ITSELF: dict[str, Planted] = {
    "no description": Planted(
        a_yard(description=""),
        "a domain says what it is",
        "description must be one line of text, not ''.",
        "class attributes",
    ),
    "settings as one text": Planted(
        a_yard(settings="small"),
        "a domain says what it is",
        "settings must be a tuple of different names, at least one, not 'small'.",
        "A tuple of one needs a comma",
    ),
    "default setting": Planted(
        a_yard(default_setting="smal"),
        "a domain says what it is",
        "the default setting 'smal' is none of the settings ('small',).",
        "misspelt",
    ),
    "instance type": Planted(
        a_yard(instance_type=dict),
        "a domain says what it is",
        "instance_type must be a frozen dataclass, not <class 'dict'>.",
        "the class itself",
    ),
    "default of an option": Planted(
        a_yard(options=(Option("floor", "damp", "what it stands on", ("dry", "wet")),)),
        "options have a default that is valid",
        "option 'floor' has the default 'damp', which is none of ('dry', 'wet').",
        "add the default",
    ),
    "self_contained": Planted(
        a_yard(self_contained=lambda self, options: {**options, "colour": options["colour"] + "!"}),
        "options stay as they are in a record",
        "self_contained changes its own answer: {'floor': 'dry', 'colour': 'red!'} and then "
        "{'floor': 'dry', 'colour': 'red!!'}.",
        "left alone",
    ),
    "unseeded instance": Planted(
        a_yard(instance=unseeded),
        "the same seed gives the same instance",
        "instance('small', 0) is YardInstance(…) and then YardInstance(…).",
        "np.random.default_rng(seed)",
    ),
    "one instance for all seeds": Planted(
        a_yard(instance=lambda self, setting, seed: YardInstance((0.5, 0.5), 0.5)),
        "another seed gives another instance",
        "seeds 0 to 4 give the same instance in every setting: YardInstance(cup=(0.5, 0.5), gap=0.5).",
        "does not look at its seed",
    ),
    "unwritable instance": Planted(
        a_yard(instance=lambda self, setting, seed: Unwritable(0.5), instance_type=Unwritable),
        "instances survive a file",
        "small: an instance cannot be written to a file and read again: …",
        "plain numbers",
    ),
}
TO_A_MODEL: dict[str, Planted] = {
    "action without a description": Planted(
        a_yard(schemas=(replace(TAKE, description=""), PUT, RING)),
        "schemas tell what there is to do",
        "action 'take' has no description.",
        "All that a model knows",
    ),
    "full stop": Planted(
        a_yard(schemas=(TAKE, PUT, replace(RING, description="ring the bell."))),
        "schemas tell what there is to do",
        "the description of action 'ring' ends with a full stop: 'ring the bell.'.",
        "The templates write one",
    ),
    "range of one value": Planted(
        a_yard(schemas=(TAKE, replace(PUT, parameters=(PUT.parameters[0], Parameter("y", 0.5, 0.5))), RING)),
        "schemas tell what there is to do",
        "parameter 'y' of action 'put' can only be 0.5.",
        "no parameter",
    ),
    "two actions of one name": Planted(
        a_yard(schemas=(TAKE, PUT, RING, ActionSchema("ring", (), (), "ring again"))),
        "schemas tell what there is to do",
        "two actions are called 'ring'.",
        "which of them",
    ),
    "two objects of one name": Planted(
        a_yard(objects=("cup", "cup")), "objects have different names", "two objects are called 'cup'.", "which of them"
    ),
    "action that cannot be read": Planted(
        a_yard(schemas=(TAKE, replace(PUT, name="take"), RING)),
        "actions read back",
        "take(['cup'], {}) is not read as it is written: …",
        "plain words",
    ),
    "no task": Planted(a_yard(task=" "), "the task is told", "task must be a text, not ' '.", "as prose"),
    "numpy in the task": Planted(
        a_yard(task=f"Bring the cup to {np.array([1.5])!r}."),
        "the task is told",
        "the task holds 'array('.",
        "f-string",
    ),
    "entities in a list": Planted(
        a_yard(describe=lambda self, state: [*Yard.describe(self, state)]),
        "the state is described",
        "describe must answer a tuple of Entity, not [Entity(…",
        "comma",
    ),
    "all digits": Planted(
        a_yard(describe=lambda self, state: (*Yard.describe(self, state), Entity("moon", {"height": 1 / 3}))),
        "the state is described",
        "height of moon is written with all its digits: 0.3333333333333333.",
        "Round",
    ),
    "object that is not described": Planted(
        a_yard(objects=("cup", "saucer")),
        "every object is told of",
        "'saucer' is an object, and neither the task nor the initial state tells of it.",
        "leaves it out",
    ),
    "description that never changes": Planted(
        a_yard(describe=lambda self, state: Yard.describe(self, self.reset())),
        "the description follows the state",
        "the description is the same before and after …, which changed the state.",
        "must look at the state",
    ),
    "description without the bell": Planted(
        a_yard(describe=lambda self, state: tuple(e for e in Yard.describe(self, state) if e.name != "bell")),
        "the description follows the state",
        "ring([], {}) changes the fact 'rung', and the description with that alone changed is the same.",
        "state.facts",
    ),
}
OF_ITS_STATES: dict[str, Planted] = {
    "reset that draws": Planted(
        a_yard(reset=lambda self: replace(Yard.reset(self), configuration=(random.uniform(0.1, 0.2), 0.5))),
        "reset answers a state",
        "reset answers {…} and then {…}.",
        "not from chance",
    ),
    "fact of two types": Planted(
        with_state(lambda before, after: replace(after, facts={"rung": int(after.facts["rung"])})),
        "states are alike",
        "fact 'rung' is a bool and then a int.",
        "keep to one type",
    ),
    "too many joints": Planted(
        a_yard(joints=(*Yard.joints, Joint("gripper"))),
        "joints fit the configuration",
        "there are 3 joints, and a configuration has 2 values.",
        "the gripper's are not among them",
    ),
    "goal as a bare truth value": Planted(
        a_yard(goal=lambda self, state: Yard.goal(self, state).achieved),
        "the goal says what is missing",
        "goal must answer a GoalStatus, not False.",
        "tells no model why",
    ),
    "the same part twice": Planted(
        a_yard(goal=lambda self, state: GoalStatus(False, ("it is not there", "it is not there"))),
        "the goal says what is missing",
        "the same part of the goal is unmet twice: ('it is not there', 'it is not there').",
        "Name the object",
    ),
    "nothing to do": Planted(
        a_yard(goal=lambda self, state: GoalStatus(True)),
        "there is something to do",
        "the goal is reached before anything is done.",
        "draw again",
    ),
}
BESIDES: dict[str, Planted] = {
    "unknown sketch": Planted(
        a_yard(skeleton=lambda self, instance: (Sketch("take", ("saucer",)),)),
        "the skeleton is made of known actions",
        "the skeleton holds take(['saucer'], ...), which is no action of this world.",
        "objects cup",
    ),
    "pieces that are sketches": Planted(
        a_yard(pieces=lambda self, instance: (Sketch("take", ("cup",)),)),
        "the pieces are made of known actions",
        "one of the pieces is Sketch(name='take', objects=('cup',)).",
        "a piece is a tuple of llm3.types.Sketch",
    ),
    "unknown sketch in a piece": Planted(
        a_yard(pieces=lambda self, instance: ((Sketch("take", ("saucer",)),),)),
        "the pieces are made of known actions",
        "a piece holds take(['saucer'], ...), which is no action of this world.",
        "objects cup",
    ),
    "witness that is a list": Planted(
        a_yard(witness=lambda self, setting, seed: [Action("ring")]),
        "the witness solves the problem",
        "witness must answer a tuple of Action or None, not [Action(name='ring', objects=(), params={})].",
        "A tuple of one needs a comma",
    ),
    "witness by chance": Planted(
        a_yard(witness=lambda self, setting, seed: (Action("ring"),) * random.randrange(1, 10**6)),
        "the witness solves the problem",
        "witness answers differently when it is asked again.",
        "along with the instance",
    ),
    "witness out of range": Planted(
        a_yard(witness=lambda self, setting, seed: (Action("put", ("cup",), {"x": 9.0, "y": 0.5}),)),
        "the witness solves the problem",
        "the witness holds put(['cup'], {'x': 9.0, 'y': 0.5}), which is no action of this world: …",
        "within the ranges of the schema",
    ),
    "witness that fails": Planted(
        a_yard(witness=lambda self, setting, seed: (Action("put", ("cup",), {"x": 1.5, "y": 0.5}),)),
        "the witness solves the problem",
        "the witness does not solve the problem: put(['cup'], {'x': 1.5, 'y': 0.5}): …",
        "more room or reach than there is",
    ),
    "witness that stops early": Planted(
        a_yard(witness=lambda self, setting, seed: (Action("ring"),)),
        "the witness solves the problem",
        "the witness does not solve the problem: at its end, …",
        "the whole goal",
    ),
    "unknown region": Planted(
        a_yard(regions=lambda self, instance: {("put", "cup", "x"): (1.5, 2.0)}),
        "regions are parts of the ranges",
        "a region goes by ('put', 'cup', 'x'), which is no parameter of this world.",
        "('place', ('box',), 'x')",
    ),
    "region outside of the range": Planted(
        a_yard(regions=lambda self, instance: {("put", ("cup",), "x"): (1.5, 2.5)}),
        "regions are parts of the ranges",
        "the region of ('put', ('cup',), 'x') is 1.5 to 2.5, and the parameter's range 0 to 2.",
        "invalid action",
    ),
    "stand-in that invents": Planted(
        a_yard(stand_in=lambda self: lambda context, rng: '{"Full Plan": ["fly([], {})"]}'),
        "the stand in answers as a model should",
        "the stand-in proposes fly([], {}): …",
        "str(action)",
    ),
    "stand-in with a generator of its own": Planted(
        a_yard(stand_in=own_chance()),
        "the stand in answers as a model should",
        "the stand-in answers differently with the same generator.",
        "its generator alone",
    ),
    "view of twins": Planted(
        a_yard(top_view=lambda self, instance, options, state: (Shape("wall", ((0, 0), (1, 0), (1, 1))),) * 2),
        "the view from above is drawn alike",
        "top_view draws two things of one name: wall, wall.",
        "by the names",
    ),
    "gullible verifier": Planted(
        a_yard(verifier=lambda self, instance, options: Gullible()),
        "the verifier tells good plans from bad",
        "the verifier finds a plan sound that does nothing.",
        "ask at the end for the goal",
    ),
    "believing verifier": Planted(
        a_yard(verifier=lambda self, instance, options: Believing(instance)),
        "the verifier tells good plans from bad",
        "the verifier finds a plan sound of which only the last action is left.",
        "not to be believed",
    ),
    "strict verifier": Planted(
        a_yard(verifier=lambda self, instance, options: Strict()),
        "the verifier tells good plans from bad",
        "the verifier refuses a plan that the world carried out: the cup is not past the wall.",
        "do not agree",
    ),
    "remade with another wall": Planted(
        a_yard(remake=remade_with_another_gap),
        "a remade world is like a new one",
        "a second world differs: …",
        "leaves something behind",
        seeds=(0, 1),
    ),
}
FAULTS = OF_ITSELF | TO_A_MODEL | OF_ITS_STATES | BESIDES
