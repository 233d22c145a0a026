"""What became of a plan that was carried out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from math import isfinite

from llm3.types.actions import Action
from llm3.types.frozen import FrozenDict
from llm3.types.state import GoalStatus, State


@dataclass(frozen=True)
class Noise:
    """By how much a simulated world differs from the plan: standard deviations of Gaussians about 0."""

    position: float = 0.0
    """Of every movable object's x and y at the start, in metres."""
    angle: float = 0.0
    """Of every movable object's turn about the vertical at the start, in radians."""
    joints: float = 0.0
    """Of what each joint's encoder is off by, all the time, in radians (metres where a joint slides)."""

    def __post_init__(self) -> None:
        for entry in fields(self):
            value = getattr(self, entry.name)
            if not (isfinite(value) and value >= 0):
                raise ValueError(f"the {entry.name} noise must be a standard deviation of 0 or more, not {value:g}")

    def __bool__(self) -> bool:
        """Whether there is any."""
        return any(getattr(self, entry.name) for entry in fields(self))


@dataclass(frozen=True)
class Slip:
    """Something that happened against the plan."""

    sentence: str
    """What, with figures, such as ``"red_box slipped by 3.1 mm in the gripper"``."""
    measures: Mapping[str, float] = field(default_factory=FrozenDict)
    """The figures by name, such as ``{"position": 0.0031}``; metres, radians."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "measures", FrozenDict(self.measures))

    def __str__(self) -> str:
        """The sentence."""
        return self.sentence


@dataclass(frozen=True)
class Executed:
    """An action that was carried out, or tried."""

    action: Action
    seconds: float
    """How long it took, with the waits for things to come to rest."""
    joint_error: float = 0.0
    """The largest difference of a joint to where the plan has it at that time, as its encoder tells, in radians
    (metres where a joint slides)."""
    joint_error_rms: float = 0.0
    """The root of the mean square of these differences, over all joints and times."""
    tool_error: float | None = None
    """The largest distance of the tool from where the plan has it at that time, in metres; None where it is not
    known."""
    slips: tuple[Slip, ...] = ()
    """What happened against the plan, in order."""


@dataclass(frozen=True)
class Execution:
    """What an executor did with a plan, and what it left."""

    start: State
    """Where it really began."""
    state: State
    """Where it really ended."""
    actions: tuple[Executed, ...]
    """One for each action of the plan."""


@dataclass(frozen=True)
class PoseError:
    """How far an object is from where it should be."""

    position: float
    """In metres."""
    angle: float
    """In radians."""


@dataclass(frozen=True)
class ExecutionReport:
    """A plan that was carried out, held against what it promised."""

    execution: Execution
    goal: GoalStatus
    """Of where it really ended."""
    pose_errors: Mapping[str, PoseError] = field(default_factory=FrozenDict)
    """By object, how far it is in the end from where the plan has it; without what is held in one of the two."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "pose_errors", FrozenDict(sorted(self.pose_errors.items())))
