"""Random scenes whose boxes stand where the robot is likely to be."""

from __future__ import annotations

import numpy as np

from llm3.types import Pose
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.scene import Box, HeldBox, Scene

TABLE = Box("table", (1.2, 2.0, 0.1), Pose((0.5, 0.0, -0.05)), fixed=True)
SIZES = ((0.07, 0.07, 0.07), (0.035, 0.035, 0.07), (0.105, 0.035, 0.07), (0.22, 0.21, 0.01), (0.4, 0.03, 0.6))


def random_configurations(kinematics: Kinematics, count: int, rng: np.random.Generator) -> np.ndarray:
    return rng.uniform(kinematics.model.low, kinematics.model.high, (count, kinematics.model.dof))


def random_pose(rng: np.random.Generator, centre: np.ndarray, spread: float) -> Pose:
    orientation = rng.normal(size=4)
    return Pose(tuple(centre + rng.normal(size=3) * spread), tuple(orientation / np.linalg.norm(orientation)))


def random_scene(kinematics: Kinematics, rng: np.random.Generator, held: bool) -> Scene:
    """A table or none, and up to six boxes near places where some link can be."""
    frames = kinematics.link_frames(random_configurations(kinematics, 6, rng), 0.04)
    boxes = [TABLE] if rng.random() < 0.5 else []
    for number, links in enumerate(frames[: rng.integers(0, 7)]):
        place = random_pose(rng, links[rng.integers(1, len(links)), :3, 3], 0.08)
        boxes.append(Box(f"box{number}", SIZES[rng.integers(len(SIZES))], place, fixed=rng.random() < 0.3))
    grasp = random_pose(rng, np.array([0.0, 0.0, 0.02]), 0.01)
    size = SIZES[rng.integers(4)]
    return Scene(tuple(boxes), HeldBox("cargo", size, grasp) if held else None, float(rng.uniform(0.0, 0.08)))
