"""Makes kitchen.png: the start and the end of a solved run of `kitchen-5`, drawn by PyBullet's software renderer.

It needs PyBullet and Pillow, which come with ``pip install '.[docs]'``, and no screen::

    python docs/pictures/make_kitchen.py
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from PIL import Image

from llm3 import Registry
from llm3.assembly import RunConfig, assemble
from llm3.types import Pose, State
from llm3_bullet.clients import connect
from llm3_bullet.model import RobotModel
from llm3_bullet.robots.panda import panda
from llm3_bullet.scene import Box
from llm3_bullet.stage import Camera, Stage
from llm3_bullet.tabletop.window import color_of
from llm3_kitchen.env import KitchenEnv
from llm3_kitchen.instance import KitchenInstance

TARGET = Path(__file__).with_name("kitchen.png")
CONFIG = RunConfig("kitchen", setting="kitchen-5", seed=0)
CAMERA = Camera(target=(0.24, 0.0, 0.12), distance=1.62, yaw=90.0, pitch=-48.0)
WIDTH, HEIGHT = 640, 560
OVERSAMPLING = 2  # the renderer does not smooth edges, so a larger picture is made smaller
MAT = {
    "store": (0.80, 0.74, 0.64),
    "sink": (0.55, 0.62, 0.68),
    "worktop": (0.78, 0.80, 0.76),
    "serving": (0.97, 0.96, 0.92),
}
"""The colours of places that have no body, so that they are seen."""


def main() -> None:
    """Solve, draw and write."""
    with assemble(Registry.discover(), CONFIG) as run:
        result, env, instance = run.solve(), run.problem.env, run.problem.instance
        if not result.plan or not isinstance(env, KitchenEnv):
            raise SystemExit("the run is not solved, so there is nothing to draw")
        pictures = [drawn(env, instance, state) for state in (result.start, result.plan[-1].state)]
    both = Image.new("RGB", (2 * WIDTH + 8, HEIGHT), "white")
    for index, picture in enumerate(pictures):
        both.paste(picture, (index * (WIDTH + 8), 0))
    both.save(TARGET, optimize=True)


def drawn(env: KitchenEnv, instance: KitchenInstance, state: State) -> Image.Image:
    """The kitchen in a state."""
    scene = env.scene(state)
    boxes = [*(trimmed(box) for box in scene.boxes), *mats(instance)]
    colors = {box.name: env.colors.get(box.name, color_of(box.name)) for box in boxes}
    colors.update({f"{place.name}_mat": MAT[place.kind] for place in instance.places if place.kind in MAT})
    with connect() as client:
        stage = Stage(client, RobotModel(panda()), colors, CAMERA)
        stage.show(boxes, state.configuration, None, scene.opening)
        pixels = stage.picture(WIDTH * OVERSAMPLING, HEIGHT * OVERSAMPLING)
    return Image.fromarray(pixels).resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS)


def mats(instance: KitchenInstance) -> Iterator[Box]:
    """Thin boxes where places are only marked on the table."""
    for place in instance.places:
        if place.kind in MAT:
            yield Box(f"{place.name}_mat", (*place.size, 0.002), Pose((*place.center, 0.0)), fixed=True)


def trimmed(box: Box) -> Box:
    """The table in a size that the renderer's shadows cover to its edges."""
    return replace(box, size=(1.2, 1.5, 0.05), pose=Pose((0.25, 0.0, -0.025))) if box.name == "table" else box


if __name__ == "__main__":
    main()
