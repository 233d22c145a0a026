"""Bodies for the boxes of one scene after another: made once for each size, and put where a scene has them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable

from llm3_bullet.clients import BulletClient
from llm3_bullet.scene import Scene, Size

Role = str
"""What a body stands for: `FIXED`, `LOOSE` or `HELD`."""
FIXED, LOOSE, HELD = "fixed", "loose", "held"
AWAY = {FIXED: (0.0, 0.0, -100.0), LOOSE: (0.0, 0.0, -100.0), HELD: (0.0, 0.0, -200.0)}
"""Where bodies wait, in metres: out of sight, and what may not touch each other apart."""
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)


class BoxPool:
    """Boxes in a PyBullet world. A body never changes its size or its role."""

    def __init__(self, client: BulletClient, make: Callable[[Size, Role], int]) -> None:
        """Start with no boxes.

        Args:
            client: The world.
            make: Makes a body and gives PyBullet's number of it.
        """
        self._client, self._make = client, make
        self._made: dict[tuple[Size, Role], list[int]] = defaultdict(list)
        self._scene = Scene()
        self.bodies: list[int] = []
        """PyBullet's numbers of the scene's boxes, in the scene's order."""
        self.held = -1
        """PyBullet's number of the held box; -1 without one."""

    @property
    def made(self) -> int:
        """How many bodies there are. PyBullet never frees all of a body's memory, so they are not removed."""
        return sum(map(len, self._made.values()))

    def show(self, scene: Scene) -> None:
        """Put the scene's boxes where they are, unless they are there already; the held one comes from the hand."""
        if scene is self._scene or scene == self._scene:
            self._scene = scene
            return
        unused = {kind: list(bodies) for kind, bodies in self._made.items()}
        self.bodies = [self._take(box.size, FIXED if box.fixed else LOOSE, unused) for box in scene.boxes]
        self.held = self._take(scene.held.size, HELD, unused) if scene.held else -1
        for box, body in zip(scene.boxes, self.bodies, strict=True):
            self._client.resetBasePositionAndOrientation(body, box.pose.position, box.pose.orientation)
        for (_, role), bodies in unused.items():
            for body in bodies:
                self._client.resetBasePositionAndOrientation(body, AWAY[role], _UPRIGHT)
        self._scene = scene

    def _take(self, size: Size, role: Role, unused: dict[tuple[Size, Role], list[int]]) -> int:
        """A body of this kind that the scene does not use yet."""
        if unused.get((size, role)):
            return unused[size, role].pop(0)
        body = self._make(size, role)
        self._made[size, role].append(body)
        return body
