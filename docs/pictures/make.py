"""Makes the pictures of the domains: the end of a solved run of each, drawn by PyBullet's software renderer.

It needs PyBullet and Pillow, which come with ``pip install '.[docs]'``, and no screen::

    python docs/pictures/make.py [NAME ...]
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

from PIL import Image

from llm3 import Registry
from llm3.assembly import RunConfig, assemble
from llm3.types import Pose
from llm3_bullet.clients import connect
from llm3_bullet.model import RobotModel
from llm3_bullet.robots.panda import panda
from llm3_bullet.scene import Box
from llm3_bullet.stage import Stage
from llm3_bullet.tabletop.env import TabletopEnv
from llm3_bullet.tabletop.window import CAMERA, color_of

FOLDER = Path(__file__).parent
RUNS: Mapping[str, RunConfig] = MappingProxyType(
    {
        "boxpack": RunConfig("boxpack", setting="hard-small", seed=0),
        "blocks": RunConfig("blocks", setting="blocks-6", seed=0),
    }
)
"""By the name of the picture."""
WIDTH, HEIGHT = 800, 600
OVERSAMPLING = 2  # the renderer does not smooth edges, so a larger picture is made smaller


def main(names: Iterable[str]) -> None:
    """Solve, draw and write."""
    for name in names:
        draw(RUNS[name], FOLDER / f"{name}.png")


def draw(config: RunConfig, target: Path) -> None:
    """The picture of one run."""
    with assemble(Registry.discover(), config) as run, connect() as client:
        plan = run.solve().plan
        if not plan or not isinstance(run.problem.env, TabletopEnv):
            raise SystemExit("the run is not solved, so there is nothing to draw")
        state, events = plan[-1].state, plan[-1].motion.events
        opening = [event.opening for event in events if event.opening is not None][-1]
        boxes = trimmed(run.problem.env.scene(state).boxes)
        stage = Stage(client, RobotModel(panda()), {box.name: color_of(box.name) for box in boxes}, CAMERA)
        stage.show(boxes, state.configuration, None, opening)
        pixels = stage.picture(WIDTH * OVERSAMPLING, HEIGHT * OVERSAMPLING)
    picture = Image.fromarray(pixels).resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS)
    picture.save(target, optimize=True)


def trimmed(boxes: Iterable[Box]) -> list[Box]:
    """The boxes with a table that the renderer's shadows cover to its edges."""
    table = {"size": (1.2, 1.5, 0.05), "pose": Pose((0.4, 0.0, -0.025))}
    return [replace(box, **table) if box.name == "table" else box for box in boxes]


if __name__ == "__main__":
    main(sys.argv[1:] or RUNS)
