"""What the robot cannot do, as values that travel back to the model."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

from llm3.types.checks import finite, texts
from llm3.types.frozen import FrozenDict
from llm3.types.stats import Stats


class FailureKind(str, Enum):
    """Why an action, or a whole reply, cannot be carried out."""

    UNREACHABLE = "unreachable"
    """Nothing takes the robot to the goal, whatever is tried: there is no inverse kinematics solution, or what the
    failure's detail says, such as that the way is cut off."""
    GOAL_IN_COLLISION = "goal in collision"
    """Every configuration that reaches the goal touches something."""
    START_IN_COLLISION = "start in collision"
    """The robot touches something where it stands."""
    NO_PATH = "no path within budget"
    """Start and goal are free, but the planner found no path between them. Another seed may find one."""
    PRECONDITION = "precondition"
    """The action makes no sense in this state, such as placing what is not held."""
    INVALID_ACTION = "invalid action"
    """The action does not fit its schema."""
    UNREADABLE_REPLY = "unreadable reply"
    """No plan can be read from the model's text."""

    @property
    def is_motion(self) -> bool:
        """Whether motion feasibility was evaluated to find out; such failures count as motion calls."""
        return self in _MOTION_KINDS

    @property
    def is_final(self) -> bool:
        """Whether the same action in the same state would fail again, whatever the random seed."""
        return self is not FailureKind.NO_PATH


_MOTION_KINDS = frozenset(
    {
        FailureKind.UNREACHABLE,
        FailureKind.GOAL_IN_COLLISION,
        FailureKind.START_IN_COLLISION,
        FailureKind.NO_PATH,
    }
)


ITSELF = "itself"
"""What the robot touches when one of its parts touches another."""


@dataclass(frozen=True)
class Contact:
    """Two things that touch, or come closer than they may."""

    part: str
    """What touches, from the robot's side, such as ``"arm"``, ``"gripper"`` or ``"held red_box"``."""
    object: str
    """What is touched; `ITSELF` for another part of the robot."""
    depth: float = 0.0
    """Penetration in metres; negative is a remaining gap."""
    normal: tuple[float, ...] = ()
    """Unit vector in the world frame that points from the object to the part: the way out."""
    point: tuple[float, ...] = ()
    """Where on the object, in metres, in the world frame."""
    link: str = ""
    """The URDF's name of the robot's link that touches; empty for what is held, and where it is not known."""
    other_link: str = ""
    """The URDF's name of the robot's link that is touched; empty unless the object is `ITSELF`."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "depth", finite("the depth of a contact", (self.depth,))[0])
        for name in ("normal", "point"):
            object.__setattr__(self, name, finite(f"the {name} of a contact", getattr(self, name)))


@dataclass(frozen=True)
class Failure:
    """Why something cannot be done, with the evidence."""

    kind: FailureKind
    detail: str = ""
    """A sentence for the model where the kind alone does not say enough."""
    objects: tuple[str, ...] = ()
    """The objects that are to blame, the most important first."""
    contacts: tuple[Contact, ...] = ()
    """What touched what, the deepest first."""
    configuration: tuple[float, ...] = ()
    """The robot's configuration that the contacts are of, or that came closest; joint values as in a state."""
    measures: Mapping[str, float] = field(default_factory=FrozenDict)
    """Figures by name, such as ``{"position_error": 0.05}``; metres, radians or counts."""
    stats: Stats = field(default=Stats(), compare=False)
    """What it cost to find out."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "objects", texts("the objects of a failure", self.objects))
        finite("the measures of a failure", self.measures.values())
        object.__setattr__(self, "measures", FrozenDict({name: float(value) for name, value in self.measures.items()}))
        object.__setattr__(self, "contacts", tuple(self.contacts))
        object.__setattr__(self, "configuration", finite("the configuration of a failure", self.configuration))
