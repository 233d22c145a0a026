"""Checks a plan again: against what the domain says of the problem, and by the domain's second look at it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from llm3.assembly import Problem
from llm3.errors import MissingCapability
from llm3.guarded import guarded
from llm3.interfaces import Env, PlanVerifier
from llm3.jsonio import dumps
from llm3.parsing import parse_reply
from llm3.records import PlanFile
from llm3.types import Action, Defect, GoalStatus, Proposal, Rejected, State, Verification


def verify(problem: Problem, plan: PlanFile) -> Verification:
    """Look at a plan a second time.

    Args:
        problem: What the plan is for; see :func:`llm3.records.open_plan`.
        plan: The plan.

    Raises:
        MissingCapability: The domain has no verifier.
        PluginError: The domain failed.
    """
    domain, env = problem.domain, problem.env
    verifier = guarded(domain.verifier, (PlanVerifier, type(None)), problem.instance, problem.options)
    if verifier is None:
        raise MissingCapability(domain.name, "verifier", "'llm3 verify'")
    departures = tuple(_departures(env, plan))
    if any(defect.number for defect in departures):
        return Verification(departures)  # a verifier need not know what to make of what is no action
    found = guarded(verifier.verify, (Verification,), plan.start, plan.actions)
    return replace(found, defects=(*departures, *_untimed(plan), *found.defects, *_unmet(env, plan)))


def _departures(env: Env, plan: PlanFile) -> Iterator[Defect]:
    """Where the plan departs from the problem: another start, or what is no action."""
    for difference in differences(plan.start, guarded(env.reset, (State,))):
        yield Defect(f"the plan does not start where the problem does: {difference}")
    for number, step in enumerate(plan.actions, start=1):
        reason = fault(env, step.action)
        if reason:
            yield Defect(reason, number, str(step.action))


def _untimed(plan: PlanFile) -> Iterator[Defect]:
    """Pieces without times in a plan whose other pieces have them."""
    pieces = [
        (number, str(step.action), segment)
        for number, step in enumerate(plan.actions, start=1)
        for segment in step.motion.segments
    ]
    if any(segment.trajectory for _, _, segment in pieces):
        for number, action, segment in pieces:
            if not segment.trajectory:
                yield Defect("it has no times, and other segments have", number, action, segment.label)


def _unmet(env: Env, plan: PlanFile) -> Iterator[Defect]:
    last = plan.actions[-1].state if plan.actions else plan.start
    for sentence in guarded(env.goal, (GoalStatus,), last).unmet:
        yield Defect(f"by its last state, the plan misses the goal: {sentence}")


def differences(said: State, true: State) -> Iterator[str]:
    """What two states do not agree on."""
    names = sorted({*said.poses, *true.poses})
    for name in names:
        if said.poses.get(name) != true.poses.get(name):
            yield f"the pose of {name} is {dumps(said.poses.get(name))}, not {dumps(true.poses.get(name))}"
    for field in ("configuration", "held", "facts"):
        if getattr(said, field) != getattr(true, field):
            yield f"{field} is {dumps(getattr(said, field))}, not {dumps(getattr(true, field))}"


def fault(env: Env, action: Action) -> str:
    """Why something is no action of this problem; empty if it is one. What a model may write decides."""
    read = parse_reply(dumps({"Full Plan": [str(action)]}), env.schemas, env.objects)
    if not isinstance(read, Proposal):
        return read.detail
    (item,) = read.actions
    if isinstance(item, Rejected):
        return item.failure.detail
    return "" if item == action else f"it reads as {item}"
