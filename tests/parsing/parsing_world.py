"""The actions and objects that the parser's tests share."""

import json

from llm3.parsing import parse_reply
from llm3.types import Action, ActionSchema, Failure, FailureKind, Parameter, Proposal, Rejected

PICK = ActionSchema("pick", ("box",))
PLACE = ActionSchema(
    "place",
    ("box",),
    (Parameter("x", 0, 1, "m"), Parameter("y", -1, 1, "m"), Parameter("theta", -3.14, 3.14, "rad")),
)
STACK = ActionSchema("stack", ("upper box", "lower box"), (Parameter("ratio", 0, 1),))
WAIT = ActionSchema("wait")
SCHEMAS = (PICK, PLACE, STACK, WAIT)
OBJECTS = ("red_box", "blue_box")

PLAN = (
    Action("pick", ("red_box",)),
    Action("place", ("red_box",), {"x": 0.51, "y": -0.02, "theta": 0.0}),
    Action("stack", ("red_box", "blue_box"), {"ratio": 0.25}),
    Action("wait"),
)
PLAN_TEXTS = tuple(map(str, PLAN))


def parse(text, skeleton=()):
    return parse_reply(text, SCHEMAS, OBJECTS, skeleton)


def reply(*items, reasoning="because"):
    """The reply in the form that is asked for."""
    return json.dumps({"Reasoning": reasoning, "Full Plan": items})


def read_one(item):
    """The action, or the rejected item, that one item of a plan is read as."""
    proposal = parse(reply(item))
    assert isinstance(proposal, Proposal)
    assert len(proposal.actions) == 1
    return proposal.actions[0]


def fault(item):
    """The sentence on an item that is no valid action."""
    rejected = read_one(item)
    assert isinstance(rejected, Rejected), rejected
    assert rejected.failure.kind is FailureKind.INVALID_ACTION
    return rejected.failure.detail


def complaint(text):
    """The sentence on a reply that cannot be read."""
    failure = parse(text)
    assert isinstance(failure, Failure), failure
    assert failure.kind is FailureKind.UNREADABLE_REPLY
    return failure.detail
