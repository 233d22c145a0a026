"""Makes boxpack.png: the end of a solved run of the box-packing task, drawn by PyBullet's software renderer.

It needs PyBullet and Pillow, which come with ``pip install '.[docs]'``, and no screen::

    python docs/pictures/make.py
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from PIL import Image

from llm3 import Registry
from llm3.assembly import RunConfig, assemble
from llm3.types import Pose
from llm3_boxpack.env import BoxpackEnv
from llm3_boxpack.window import CAMERA, color_of
from llm3_bullet.clients import connect
from llm3_bullet.model import RobotModel
from llm3_bullet.robots.panda import panda
from llm3_bullet.scene import Box
from llm3_bullet.stage import Stage

TARGET = Path(__file__).with_name("boxpack.png")
CONFIG = RunConfig("boxpack", setting="hard-small", seed=0)
WIDTH, HEIGHT = 800, 600
OVERSAMPLING = 2  # the renderer does not smooth edges, so a larger picture is made smaller


def main() -> None:
    """Solve, draw and write."""
    with assemble(Registry.discover(), CONFIG) as run, connect() as client:
        plan = run.solve().plan
        if not plan or not isinstance(run.problem.env, BoxpackEnv):
            raise SystemExit("the run is not solved, so there is nothing to draw")
        state, events = plan[-1].state, plan[-1].motion.events
        opening = [event.opening for event in events if event.opening is not None][-1]
        boxes = trimmed(run.problem.env.scene(state).boxes)
        stage = Stage(client, RobotModel(panda()), {box.name: color_of(box.name) for box in boxes}, CAMERA)
        stage.show(boxes, state.configuration, None, opening)
        pixels = stage.picture(WIDTH * OVERSAMPLING, HEIGHT * OVERSAMPLING)
    picture = Image.fromarray(pixels).resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS)
    picture.save(TARGET, optimize=True)


def trimmed(boxes: Iterable[Box]) -> list[Box]:
    """The boxes with a table that the renderer's shadows cover to its edges."""
    table = {"size": (1.2, 1.5, 0.05), "pose": Pose((0.4, 0.0, -0.025))}
    return [replace(box, **table) if box.name == "table" else box for box in boxes]


if __name__ == "__main__":
    main()
