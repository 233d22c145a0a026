"""A corridor on paper, and attempts in it that fail in every way: what feedback, prompts and backends are tried on."""

from __future__ import annotations

from dataclasses import dataclass

from llm3.types import (
    Action,
    ActionSchema,
    Attempt,
    Contact,
    Context,
    Entity,
    Failure,
    FailureKind,
    Feedback,
    GoalStatus,
    Outcome,
    Parameter,
    Proposal,
    Rejected,
    Remark,
    Sketch,
)

SCHEMAS = (
    ActionSchema("go", (), (Parameter("x", 0.25, 2.5, "cm"), Parameter("y", -1.5, 1.75, "cm")), "walk to (x, y)"),
    ActionSchema("take", ("vessel",), (), "pick up the cup if it is < 2 kg"),
    ActionSchema("put", ("vessel", "ledge"), (Parameter("turn", -3.125, 3.0, "rad"),), "put the held cup on the shelf"),
)
OBJECTS = ("green_cup", "oak_shelf")
SKELETON = (Sketch("go"), Sketch("take", ("green_cup",)), Sketch("put", ("green_cup", "oak_shelf")))
STATE = (
    Entity("robot", {"position": (0.125, 0.5), "hand": "open & empty"}),
    Entity("green_cup", {"position": (1.375, 0.625), "height": 0.0875}),
    Entity("oak_shelf", {"x range": (1.8125, 2.4375)}),
)
TASK = "A robot in a corridor has to put the cup named green_cup on the shelf named oak_shelf, at a height < 1.5 m."
UNMET = ("green_cup is not on oak_shelf", "the hand of the robot is not empty")
NOTES = ("green_cup slid 12 mm", "tin_kettle toppled")
"""Of an action that worked, and of one that failed."""
DETAIL = "the lid of the pot is open too wide"
GO, TAKE = Action("go", (), {"x": 1.25, "y": 0.5}), Action("take", ("green_cup",))
PUT = Action("put", ("green_cup", "oak_shelf"), {"turn": 0.5})
BLAMED, ALSO_BLAMED = "oak_shelf", "tin_lamp"
HELD = "held green_cup"
"""A part of the robot, so to speak, and no obstacle."""


def context(trace: tuple[Feedback, ...] = (), skeleton: tuple[Sketch, ...] = (), objects: bool = True) -> Context:
    """What a prompt is rendered from; without objects there are no actions that take some."""
    if objects:
        return Context(TASK, SCHEMAS, OBJECTS, STATE, trace, skeleton)
    return Context(TASK, SCHEMAS[:1], (), STATE, trace, skeleton)


def trace() -> tuple[Feedback, ...]:
    """What a prompt tells of earlier attempts: a plan that failed, and a reply that could not be read."""
    remarks = (
        Remark(str(GO), "feasible", "There was room at 17 places."),
        Remark(str(TAKE), "failed", "The hand hits the lid of a pot at x < 1 m.", FailureKind.GOAL_IN_COLLISION),
        Remark(str(PUT), "not tried"),
    )
    return Feedback(1, remarks, "Still missing: a saucer."), Feedback(2, (), "The second reply was no plan at all.")


@dataclass(frozen=True)
class Told:
    """An attempt, and what it is about."""

    name: str
    attempt: Attempt
    failure: Failure | None = None


def attempts() -> tuple[Told, ...]:
    """Attempts that did not reach the goal: each kind of failure alone and mid-plan, and plans that just fell short."""
    found = [
        Told("a plan that falls short", _attempt((GO, TAKE), (Outcome(GO), Outcome(TAKE, moved=False)))),
        Told("an empty plan", _attempt((), ())),
    ]
    for kind in FailureKind:
        failure = _failure(kind)
        if kind is FailureKind.UNREADABLE_REPLY:
            found.append(Told(kind.value, Attempt(3, GoalStatus(False, UNMET), None, failure), failure))
            continue
        item = Rejected("put(['green_cup'], {})", failure) if kind is FailureKind.INVALID_ACTION else PUT
        last = Outcome(item, failure)
        found.append(Told(f"{kind.value}, alone", _attempt((item,), (last,)), failure))
        worked = Outcome(GO, notes=NOTES[:1]), Outcome(TAKE, reused=True, moved=False)
        outcomes = (*worked, Outcome(item, failure, notes=NOTES[1:]))
        found.append(Told(f"{kind.value}, mid-plan", _attempt((GO, TAKE, item, GO), outcomes), failure))
        if kind is not FailureKind.INVALID_ACTION:
            bare = Failure(kind)
            found.append(Told(f"{kind.value}, without evidence", _attempt((PUT,), (Outcome(PUT, bare),)), bare))
        if kind.is_motion:
            told = Failure(kind, DETAIL)
            found.append(Told(f"{kind.value}, with a detail", _attempt((PUT,), (Outcome(PUT, told),)), told))
    return tuple(found)


def _attempt(actions: tuple[Action | Rejected, ...], outcomes: tuple[Outcome, ...]) -> Attempt:
    return Attempt(3, GoalStatus(False, UNMET), Proposal(actions, "because"), outcomes=outcomes)


def _failure(kind: FailureKind) -> Failure:
    contacts = (Contact(HELD, BLAMED, 0.0125, (0.0, 0.0, 1.0)), Contact("gripper", ALSO_BLAMED, 0.0075))
    match kind:
        case FailureKind.PRECONDITION:
            return Failure(kind, f"green_cup is not held, so it cannot be put on {BLAMED}", objects=(BLAMED,))
        case FailureKind.INVALID_ACTION:
            return Failure(kind, f"put takes 2 objects (cup, {BLAMED}), not 1")
        case FailureKind.UNREADABLE_REPLY:
            return Failure(kind, "no complete plan can be read from the reply")
        case FailureKind.UNREACHABLE:
            return Failure(kind, objects=(BLAMED, ALSO_BLAMED), measures={"position_error": 0.05})
        case _:
            objects = BLAMED, ALSO_BLAMED
            return Failure(kind, objects=objects, contacts=contacts, configuration=(1.25, 0.5))
