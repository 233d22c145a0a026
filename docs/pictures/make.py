"""Makes the pictures of the domains with an arm: how solved runs end, and how problems that may not be solved begin.

It needs PyBullet and Pillow, which come with ``pip install '.[docs]'``, and no screen::

    python docs/pictures/make.py [NAME ...]
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing
from pathlib import Path

from PIL import Image

from llm3 import Registry
from llm3.assembly import Problem, RunConfig, assemble
from llm3.playback import frames, open_stage
from llm3.types import Moment, State, moment_of

FOLDER = Path(__file__).parent
RUNS = {
    "boxpack": (RunConfig("boxpack", setting="hard-small", seed=0), ("end",)),
    "blocks": (RunConfig("blocks", setting="blocks-6", seed=0), ("end",)),
    "kitchen": (RunConfig("kitchen", setting="kitchen-5", seed=0), ("start", "end")),
}
"""By the name of the picture: the run, and which moments of it stand side by side."""
STARTS = {
    "families": tuple(RunConfig("boxpack", setting) for setting in ("dense-8", "far-8", "clutter-8", "lanes-8")),
    "rebuild": (RunConfig("blocks", "rebuild-10", 1000),),
    "kitchen-cramped": (RunConfig("kitchen", "cramped-6"),),
}
"""By the name of the picture: problems that are shown as they begin, two in a row."""
SIZE, SMALL = (800, 600), (480, 330)
"""Of a picture, and of one of several problems."""
GAP = 8
OVERSAMPLING = 2  # the renderer does not smooth edges, so a larger picture is made smaller
COLORS = 128  # of how problems begin: a palette makes these files small


def main(names: Iterable[str]) -> None:
    """Solve, draw and write."""
    for name in names:
        if name in RUNS:
            pictures = list(drawn(*RUNS[name]))
            whole = arranged(pictures, columns=len(pictures))
        else:
            size = SIZE if len(STARTS[name]) == 1 else SMALL
            whole = arranged([beginning(config, size) for config in STARTS[name]], columns=2).quantize(COLORS)
        whole.save(FOLDER / f"{name}.png", optimize=True)


def arranged(pictures: Sequence[Image.Image], columns: int) -> Image.Image:
    """Pictures of one size, in rows."""
    (width, height), columns = pictures[0].size, min(columns, len(pictures))
    rows = -(-len(pictures) // columns)
    whole = Image.new("RGB", (columns * (width + GAP) - GAP, rows * (height + GAP) - GAP), "white")
    for index, picture in enumerate(pictures):
        row, column = divmod(index, columns)
        whole.paste(picture, (column * (width + GAP), row * (height + GAP)))
    return whole


def drawn(config: RunConfig, wanted: Iterable[str]) -> Iterator[Image.Image]:
    """Pictures of one run."""
    with assemble(Registry.discover(), config) as run:
        result, problem = run.solve(), run.problem
    if not result.solved:
        raise SystemExit("the run is not solved, so there is nothing to draw")
    moments: list[Moment] = [frame.moment for frame in frames(result.start, result.plan, rate=5.0)]
    shown = {"start": moments[0], "end": moments[-1]}
    yield from shots(problem, result.start, [shown[name] for name in wanted], SIZE)


def beginning(config: RunConfig, size: tuple[int, int]) -> Image.Image:
    """How a problem begins."""
    with assemble(Registry.discover(), config) as run:
        problem, start = run.problem, run.problem.env.reset()
    (picture,) = shots(problem, start, [moment_of(start)], size)
    return picture


def shots(problem: Problem, start: State, moments: Iterable[Moment], size: tuple[int, int]) -> Iterator[Image.Image]:
    """Pictures of moments of a problem."""
    with closing(open_stage(problem.domain, problem.instance, problem.options, start, "a picture")) as stage:
        for moment in moments:
            stage.show(moment)
            pixels = stage.picture(size[0] * OVERSAMPLING, size[1] * OVERSAMPLING)
            yield Image.fromarray(pixels).resize(size, Image.Resampling.LANCZOS)


if __name__ == "__main__":
    main(sys.argv[1:] or (*RUNS, *STARTS))
