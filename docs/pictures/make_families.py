"""Makes the picture of the families of box packing problems: how one of each begins.

It needs PyBullet and Pillow, which come with ``pip install '.[docs]'``, and no screen::

    python docs/pictures/make_families.py
"""

from __future__ import annotations

from contextlib import closing
from pathlib import Path

from PIL import Image

from llm3 import Registry
from llm3.assembly import choose_instance, open_problem
from llm3.playback import open_stage
from llm3.types import moment_of

FILE = Path(__file__).parent / "families.png"
SETTINGS = ("dense-8", "far-8", "clutter-8", "lanes-8")
WIDTH, HEIGHT, GAP = 480, 330, 6
OVERSAMPLING = 2  # the renderer does not smooth edges, so a larger picture is made smaller
COLORS = 128
"""Of the picture: flat colours need no more, and the file is a third as large."""


def main() -> None:
    """Draw and write."""
    whole = Image.new("RGB", (2 * WIDTH + GAP, 2 * HEIGHT + GAP), "white")
    for index, setting in enumerate(SETTINGS):
        row, column = divmod(index, 2)
        whole.paste(beginning(setting), (column * (WIDTH + GAP), row * (HEIGHT + GAP)))
    whole.quantize(COLORS).save(FILE, optimize=True)


def beginning(setting: str) -> Image.Image:
    """How a problem begins."""
    domain = Registry.discover().domain("boxpack")
    with open_problem(domain, choose_instance(domain, setting, 0), {}) as problem:
        start = problem.env.reset()
        stage = open_stage(domain, problem.instance, problem.options, start, "a picture")
        with closing(stage):
            stage.show(moment_of(start))
            pixels = stage.picture(WIDTH * OVERSAMPLING, HEIGHT * OVERSAMPLING)
    return Image.fromarray(pixels).resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS)


if __name__ == "__main__":
    main()
