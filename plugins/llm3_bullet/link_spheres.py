"""A robot covered by spheres that move with it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from llm3_bullet.hulls import MARGIN
from llm3_bullet.poses import as_matrix
from llm3_bullet.scene import HeldBox
from llm3_bullet.spheres import cover, cover_box

Array = NDArray[np.float64]

TOLERANCE = 2e-4
"""Metres that PyBullet's distances may be short of the truth."""
SLAB = 0.08
"""Greatest thickness in metres of the slab of a link that one sphere covers."""


@dataclass(frozen=True, eq=False)
class LinkSpheres:
    """S spheres, each fixed to a link, that cover what is fixed to these links."""

    links: NDArray[np.intp]
    """(S,): the number of the link."""
    centres: Array
    """(S, 3) in metres, in the link's frame."""
    radii: Array
    """(S,) in metres, PyBullet's margin and tolerance included."""


def spheres_of_links(hulls: Sequence[Array], slab: float = SLAB) -> LinkSpheres:
    """Spheres around all links, in the order of the links.

    Args:
        hulls: For each link, in the model's order, points (V, 3) in its frame whose convex hull covers it; V may be 0.
        slab: Greatest thickness in metres of the slab that one sphere covers.
    """
    covers = [(link, *cover(hull, slab)) for link, hull in enumerate(hulls) if len(hull)]
    return LinkSpheres(
        np.concatenate([np.full(len(radii), link, dtype=np.intp) for link, _, radii in covers]),
        np.concatenate([centres for _, centres, _ in covers]),
        np.concatenate([radii for _, _, radii in covers]) + (MARGIN + TOLERANCE),
    )


def spheres_of_held(held: HeldBox | None, tool: int) -> LinkSpheres:
    """Spheres around a held box, fixed to the tool link of this number; none if nothing is held."""
    if held is None:
        return LinkSpheres(np.empty(0, dtype=np.intp), np.empty((0, 3)), np.empty(0))
    grasp = as_matrix(held.grasp)
    centres, radius = cover_box(held.size)
    return LinkSpheres(
        np.full(len(centres), tool, dtype=np.intp),
        centres @ grasp[:3, :3].T + grasp[:3, 3],
        np.full(len(centres), radius + TOLERANCE),
    )
