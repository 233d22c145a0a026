"""Writes a page on which a plan is played in three dimensions: one file, which needs no network."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, redirect_stdout
from dataclasses import dataclass
from importlib.util import find_spec
from io import StringIO
from math import cos, radians, sin
from typing import TYPE_CHECKING

import numpy as np

from llm3.errors import MissingDependency
from llm3.interfaces import Frame as Place
from llm3.interfaces import Scenery
from llm3.playback.controls import Mark, with_controls
from llm3.playback.evidence import Touch, told, touching
from llm3.types import Body, Camera, Color, Moment

if TYPE_CHECKING:
    from viser import IcosphereHandle, MeshHandle, ViserServer

MARKED: Color = (1.0, 0.25, 0.75)
"""The colour of what touches something."""
DOT = 0.012
"""The radius in metres of the dot where it touches."""
FIELD_OF_VIEW = 45.0
"""Degrees from the upper edge to the lower one, as in PyBullet's pictures."""
BACK = 1.2
"""How many times as far away one looks from, as the window may be wide and low."""
PAUSE = 0.5
"""Seconds between two chapters."""
SURELY = 0.1
"""Seconds after its beginning in which a chapter is gone to: the player's clock rounds."""


@dataclass(frozen=True)
class Chapter:
    """A part of a replay that can be gone to."""

    title: str
    """Such as ``"The plan"``."""
    moments: Iterable[Moment]
    """What is where, in the order of their times; the first is the chapter's beginning."""
    touches: Sequence[Touch] = ()
    """What is marked all the while."""


def replay_page(title: str, scenery: Scenery, chapters: Iterable[Chapter]) -> str:
    """The page, with buttons to play and pause and for every chapter, a slider, and a view that can be turned.

    It plays when it is asked to, and obeys messages: see `controls.js`.

    Args:
        title: What the page is called.
        scenery: What there is to see.
        chapters: At least one; they are played one after another.

    Raises:
        MissingDependency: viser, which exports scenes, is not installed.
    """
    if find_spec("viser") is None:
        raise MissingDependency("a replay needs viser, which is not installed: pip install 'llm3[viz]'.")
    marks: list[Mark] = []
    now = 0.0
    with _server() as server:
        scene = _Scene(server, scenery)
        recording = server.get_scene_serializer()
        for chapter in chapters:
            if marks:
                recording.insert_sleep(PAUSE)
                now += PAUSE
            began = now
            scene.mark(chapter.touches)
            for seconds, moment in _since_the_first(chapter.moments):
                recording.insert_sleep(began + seconds - now)
                now = began + seconds
                scene.place(scenery.places(moment))
            begin, end = round(began + SURELY, 2), round(now + SURELY, 2)
            marks.append(Mark(chapter.title, "; ".join(map(told, chapter.touches)), begin, end))
        recording.insert_sleep(PAUSE)
        return with_controls(recording.as_html(), title, marks)


def _since_the_first(moments: Iterable[Moment]) -> Iterator[tuple[float, Moment]]:
    """Each moment, and how many seconds later than the first it is; time does not run backwards."""
    first, seconds = None, 0.0
    for moment in moments:
        first = moment.time if first is None else first
        seconds = max(seconds, moment.time - first)
        yield seconds, moment


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
        self._places: dict[str, Place | None] = {}
        self._marked: frozenset[str] = frozenset()
        self._dots: list[IcosphereHandle] = []
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
        from scipy.spatial.transform import Rotation

        for name, surfaces in self._surfaces.items():
            place, before = places.get(name), self._places.get(name)
            if place is not None and before is not None and np.array_equal(place, before):
                continue
            self._places[name] = place
            for handle, _ in surfaces:
                handle.visible = place is not None
                if place is not None:
                    x, y, z, w = Rotation.from_matrix(place[:3, :3]).as_quat()
                    handle.wxyz, handle.position = (w, x, y, z), tuple(place[:3, 3])

    def mark(self, touches: Sequence[Touch]) -> None:
        """Colour what touches, put a dot where it does, and nothing else."""
        names = touching(touches)
        for name in names ^ self._marked:
            for handle, color in self._surfaces.get(name, ()):
                handle.color = _bytes(MARKED if name in names else color)
        self._marked = names
        points = [touch.contact.point for touch in touches if touch.contact.point]
        while len(self._dots) < len(points):
            self._dots.append(self._server.scene.add_icosphere(f"/contact/{len(self._dots)}", DOT, _bytes(MARKED)))
        for number, dot in enumerate(self._dots):
            dot.visible = number < len(points)
            if dot.visible:
                dot.position = np.array(points[number])


def _look(server: ViserServer, camera: Camera) -> None:
    """Look from where pictures are taken."""
    yaw, pitch = radians(camera.yaw), radians(camera.pitch)
    away = np.array((sin(yaw) * cos(pitch), -cos(yaw) * cos(pitch), -sin(pitch))) * camera.distance * BACK
    server.initial_camera.position = tuple(np.array(camera.target) + away)
    server.initial_camera.look_at = camera.target
    server.initial_camera.up = (0.0, 0.0, 1.0)
    server.initial_camera.fov = radians(FIELD_OF_VIEW)


def _bytes(color: Color) -> tuple[int, int, int]:
    red, green, blue = (round(255 * part) for part in color)
    return red, green, blue
