"""What a world tells of itself."""

from __future__ import annotations

from dataclasses import dataclass, fields

from llm3.interfaces import Env, Joint
from llm3.testing.conformance.values import difference
from llm3.types import ActionSchema, Entity, GoalStatus, State


@dataclass(frozen=True)
class Look:
    """What a world tells of itself before anything is done in it."""

    task: str
    schemas: tuple[ActionSchema, ...]
    objects: tuple[str, ...]
    joints: tuple[Joint, ...]
    reset: State
    describe: tuple[Entity, ...]
    goal: GoalStatus

    @classmethod
    def at(cls, env: Env) -> Look:
        """What it tells now."""
        start = env.reset()
        shown = env.describe(start)
        return cls(env.task, env.schemas, env.objects, env.joints, start, shown, env.goal(start))


def unlike(one: Look, other: Look) -> str:
    """Where two worlds tell different things of themselves, as a phrase; empty where they do not."""
    pairs = ((field.name, getattr(one, field.name), getattr(other, field.name)) for field in fields(Look))
    return next((found for name, a, b in pairs if (found := difference(a, b, name))), "")
