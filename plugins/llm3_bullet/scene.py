"""A snapshot of everything that the robot must not run into, as data."""

from __future__ import annotations

from dataclasses import dataclass

from llm3.types import Pose

Size = tuple[float, float, float]
"""Full side lengths x, y, z in metres."""


@dataclass(frozen=True)
class Box:
    """A box in the world."""

    name: str
    size: Size
    pose: Pose
    """Of the box's centre, in the world frame."""
    fixed: bool = False
    """Whether nothing moves it, such as a table."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "size", _checked(self.name, self.size))


@dataclass(frozen=True)
class HeldBox:
    """A box in the gripper; it moves with the tool frame."""

    name: str
    size: Size
    grasp: Pose
    """Of the box's centre, in the tool frame."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "size", _checked(self.name, self.size))


@dataclass(frozen=True)
class Scene:
    """The robot's surroundings: boxes, what it holds, and how far its gripper is open."""

    boxes: tuple[Box, ...] = ()
    held: HeldBox | None = None
    opening: float = 0.0
    """Distance between the fingers in metres."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "boxes", tuple(self.boxes))
        names = [box.name for box in self.boxes] + ([self.held.name] if self.held else [])
        for name in names:
            if names.count(name) > 1:
                raise ValueError(f"two boxes are called {name!r}; the boxes are {', '.join(names)}")


def _checked(name: str, size: Size) -> Size:
    if len(size) != 3 or not all(side > 0 for side in size):
        raise ValueError(f"the size of {name!r} must be three positive lengths in metres, not {size}")
    x, y, z = map(float, size)
    return x, y, z
