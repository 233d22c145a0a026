"""A robot among boxes, in three dimensions, for whoever draws it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from importlib.util import find_spec
from typing import TYPE_CHECKING

import numpy as np

from llm3.errors import MissingDependency
from llm3.interfaces import Frame, Scenery
from llm3.types import GREY, Body, Camera, Color, Moment, Pose, Surface, box_surface
from llm3_bullet.clients import BulletClient, connect, quiet
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.mounting import urdf_file
from llm3_bullet.poses import as_matrix
from llm3_bullet.robot import RobotDescription
from llm3_bullet.scene import Box

if TYPE_CHECKING:
    from trimesh import Trimesh

PLAIN = (1.0, 1.0, 1.0)
"""The colour of shapes for which a URDF has none."""
LIGHT: Color = (0.9, 0.9, 0.9)
"""The colour of meshes for which their file has none."""


class BulletScenery(Scenery):
    """The robot as its URDF has it, and boxes."""

    def __init__(self, model: RobotModel, boxes: Iterable[Box], colors: Mapping[str, Color], camera: Camera) -> None:
        """Read the robot's meshes.

        Args:
            model: The robot.
            boxes: What stands where; those that moments tell of move.
            colors: Colours of boxes by name; others are grey.
            camera: Where one looks from at first.

        Raises:
            MissingDependency: trimesh, which reads meshes, is not installed.
        """
        if find_spec("trimesh") is None:
            raise MissingDependency("a replay needs trimesh, which is not installed: pip install 'llm3[viz]'.")
        self._kinematics, self._camera = Kinematics(model), camera
        self._boxes = {box.name: box for box in boxes}
        looks = _looks(model.description)
        links = (Body(name, tuple(looks[name]), "robot") for name in model.links if name in looks)
        things = (
            Body(box.name, (box_surface(box.size, colors.get(box.name, GREY)),), "fixed" if box.fixed else "object")
            for box in self._boxes.values()
        )
        self._bodies = (*links, *things)
        self._shown = {body.name for body in self._bodies}

    @property
    def bodies(self) -> tuple[Body, ...]:
        """The links, the furniture and the boxes."""
        return self._bodies

    @property
    def camera(self) -> Camera:
        """As pictures are taken."""
        return self._camera

    def places(self, moment: Moment) -> Mapping[str, Frame]:
        """Where they are; the fingers are open until a motion has told how far they are."""
        model, q = self._kinematics.model, np.array([moment.configuration])
        opening = model.description.gripper.max_opening if moment.opening is None else moment.opening
        links = zip(model.links, self._kinematics.link_frames(q, opening)[0], strict=True)
        found: dict[str, Frame] = {name: frame for name, frame in links if name in self._shown}
        found.update((name, as_matrix(box.pose)) for name, box in self._boxes.items() if box.fixed)
        found.update((name, as_matrix(pose)) for name, pose in moment.poses.items())
        if moment.held:
            found[moment.held.object] = self._kinematics.tool(q)[0] @ as_matrix(moment.held.grasp)
        return found


@lru_cache(4)  # a robot has many meshes, and a report of an experiment shows it in every run
def _looks(robot: RobotDescription) -> Mapping[str, list[Surface]]:
    """What each link looks like, as PyBullet reads the URDF."""
    found: dict[str, list[Surface]] = {}
    links = RobotModel(robot).links
    with connect() as client, urdf_file(robot) as file:
        with quiet():
            body = client.loadURDF(str(file), useFixedBase=True)
        for _, link, kind, size, source, position, orientation, color, *_ in client.getVisualShapeData(body):
            frame = as_matrix(Pose(position, orientation))
            for mesh in _meshes(client, kind, size, source.decode()):
                mesh.apply_transform(frame)
                look = _own_color(mesh) if tuple(color[:3]) == PLAIN else tuple(color[:3])
                surface = Surface(mesh.vertices, mesh.faces, look)
                found.setdefault(links[link + 1], []).append(surface)
    return found


def _meshes(client: BulletClient, kind: int, size: tuple[float, ...], source: str) -> Iterator[Trimesh]:
    """The meshes of a visual shape, one for each material; shapes of other kinds do not occur in a URDF."""
    import trimesh

    if kind == client.GEOM_MESH:
        for mesh in trimesh.load_scene(source).dump():
            if isinstance(mesh, trimesh.Trimesh):  # a file may hold lines and points as well
                mesh.vertices = mesh.vertices * size
                yield mesh
    elif kind == client.GEOM_BOX:
        yield trimesh.creation.box(size)
    elif kind == client.GEOM_CYLINDER:
        yield trimesh.creation.cylinder(radius=size[1], height=size[0])
    elif kind == client.GEOM_CAPSULE:
        yield trimesh.creation.capsule(height=size[0], radius=size[1])
    elif kind == client.GEOM_SPHERE:
        yield trimesh.creation.icosphere(radius=size[0])


def _own_color(mesh: Trimesh) -> Color:
    """What a mesh's file says of its colour."""
    main = getattr(getattr(mesh.visual, "material", None), "main_color", None)
    return LIGHT if main is None else (float(main[0]) / 255, float(main[1]) / 255, float(main[2]) / 255)
