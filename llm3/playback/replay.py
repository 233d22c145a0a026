"""Writes a page on which a plan is played in three dimensions: one file, which needs no network."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from importlib.util import find_spec
from io import StringIO
from math import cos, radians, sin
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.transform import Rotation

from llm3.errors import MissingDependency
from llm3.interfaces import Frame as Place
from llm3.interfaces import Scenery
from llm3.playback.frames import Frame
from llm3.types import Body, Camera, Color

if TYPE_CHECKING:
    from viser import MeshHandle, ViserServer

MARKED: Color = (1.0, 0.25, 0.75)
"""The colour of what touches something."""
DOT = 0.012
"""The radius in metres of the dot where it touches."""


@dataclass(frozen=True)
class Mark:
    """Something to be seen from a moment on."""

    time: float
    """Seconds since the beginning."""
    bodies: tuple[str, ...]
    """What is marked, by name."""
    points: tuple[tuple[float, ...], ...]
    """Where they touch, in metres, in the world frame."""


def replay_page(scenery: Scenery, frames: Iterable[Frame], marks: Iterable[Mark] = ()) -> str:
    """The page, with buttons to play and pause, a slider, and a view that can be turned.

    Args:
        scenery: What there is to see.
        frames: What is where, in the order of their times.
        marks: What touches something, in the order of their times.

    Raises:
        MissingDependency: viser, which exports scenes, is not installed.
    """
    if find_spec("viser") is None:
        raise MissingDependency("a replay needs viser, which is not installed: pip install 'llm3[viz]'.")
    waiting = list(marks)
    with _server() as server:
        scene = _Scene(server, scenery)
        recording = server.get_scene_serializer()
        now = 0.0
        for frame in frames:
            moment = frame.moment
            recording.insert_sleep(max(0.0, moment.time - now))
            now = max(now, moment.time)
            scene.place(scenery.places(moment))
            while waiting and waiting[0].time <= now:
                scene.mark(waiting.pop(0))
        return recording.as_html()


@contextmanager
def _server() -> Iterator[ViserServer]:
    """What viser needs to hold a scene; it listens on loopback for as long as the page is made, and nobody comes."""
    import viser

    with redirect_stdout(StringIO()):  # it tells of itself there, where results go
        server = viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
        try:
            yield server
        finally:
            server.stop()


class _Scene:
    """The bodies in a viser scene."""

    def __init__(self, server: ViserServer, scenery: Scenery) -> None:
        self._server = server
        self._surfaces: dict[str, list[tuple[MeshHandle, Color]]] = {}
        self._bodies: dict[str, Place | None] = {}
        self._dots = 0
        server.scene.set_up_direction("+z")
        _look(server, scenery.camera)
        for body in scenery.bodies:
            self._surfaces[body.name] = list(self._added(body))

    def _added(self, body: Body) -> Iterator[tuple[MeshHandle, Color]]:
        for number, surface in enumerate(body.surfaces):
            handle = self._server.scene.add_mesh_simple(
                f"/{body.kind}/{body.name}/{number}",
                surface.corners.astype(np.float32),
                surface.triangles.astype(np.uint32),
                color=_bytes(surface.color),
                flat_shading=body.kind != "robot",
            )
            yield handle, surface.color

    def place(self, places: Mapping[str, Place]) -> None:
        """Move what has moved."""
        for name, surfaces in self._surfaces.items():
            place, before = places.get(name), self._bodies.get(name)
            if place is not None and before is not None and np.array_equal(place, before):
                continue
            self._bodies[name] = place
            for handle, _ in surfaces:
                handle.visible = place is not None
                if place is not None:
                    x, y, z, w = Rotation.from_matrix(place[:3, :3]).as_quat()
                    handle.wxyz, handle.position = (w, x, y, z), tuple(place[:3, 3])

    def mark(self, mark: Mark) -> None:
        """Colour what touches, and put a dot where it does."""
        for name, surfaces in self._surfaces.items():
            for handle, color in surfaces:
                handle.color = _bytes(MARKED if name in mark.bodies else color)
        for number in range(self._dots):
            self._server.scene.remove_by_name(f"/contact/{number}")
        for number, point in enumerate(mark.points):
            self._server.scene.add_icosphere(f"/contact/{number}", DOT, _bytes(MARKED), position=np.array(point))
        self._dots = len(mark.points)


def _look(server: ViserServer, camera: Camera) -> None:
    """Look from where pictures are taken."""
    yaw, pitch = radians(camera.yaw), radians(camera.pitch)
    away = np.array((sin(yaw) * cos(pitch), -cos(yaw) * cos(pitch), -sin(pitch))) * camera.distance
    server.initial_camera.position = tuple(np.array(camera.target) + away)
    server.initial_camera.look_at = camera.target
    server.initial_camera.up = (0.0, 0.0, 1.0)


def _bytes(color: Color) -> tuple[int, int, int]:
    red, green, blue = (round(255 * part) for part in color)
    return red, green, blue
