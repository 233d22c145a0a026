"""Makes the pictures of the domains with an arm: the end of a solved run of each, or a start.

It needs PyBullet and Pillow, which come with ``pip install '.[docs]'``, and no screen::

    python docs/pictures/make.py [NAME ...]
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

from PIL import Image

from llm3 import Registry
from llm3.assembly import Problem, RunConfig, assemble
from llm3.playback import frames, open_stage
from llm3.types import Moment, State

FOLDER = Path(__file__).parent
RUNS = {
    "boxpack": (RunConfig("boxpack", setting="hard-small", seed=0), ("end",)),
    "blocks": (RunConfig("blocks", setting="blocks-6", seed=0), ("end",)),
    "kitchen": (RunConfig("kitchen", setting="kitchen-5", seed=0), ("start", "end")),
}
"""By the name of the picture: the run, and which moments of it stand side by side."""
STARTS = {"rebuild": RunConfig("blocks", setting="rebuild-10", seed=1000)}
"""By the name of the picture: problems that are shown as they start, which no run has to solve."""
WIDTH, HEIGHT, GAP = 800, 600, 8
COLORS = 256  # of a start, whose file is small then
OVERSAMPLING = 2  # the renderer does not smooth edges, so a larger picture is made smaller


def main(names: Iterable[str]) -> None:
    """Solve, draw and write."""
    for name in names:
        pictures = list(drawn(*RUNS[name]) if name in RUNS else started(STARTS[name]))
        whole = Image.new("RGB", (len(pictures) * (WIDTH + GAP) - GAP, HEIGHT), "white")
        for index, picture in enumerate(pictures):
            whole.paste(picture, (index * (WIDTH + GAP), 0))
        if name in STARTS:
            whole = whole.quantize(COLORS)
        whole.save(FOLDER / f"{name}.png", optimize=True)


def drawn(config: RunConfig, wanted: Iterable[str]) -> Iterator[Image.Image]:
    """Pictures of one run."""
    with assemble(Registry.discover(), config) as run:
        result, problem = run.solve(), run.problem
    if not result.solved:
        raise SystemExit("the run is not solved, so there is nothing to draw")
    moments: list[Moment] = [frame.moment for frame in frames(result.start, result.plan, rate=5.0)]
    shown = {"start": moments[0], "end": moments[-1]}
    yield from pictures_of(problem, result.start, [shown[name] for name in wanted])


def started(config: RunConfig) -> Iterator[Image.Image]:
    """The picture of a start."""
    with assemble(Registry.discover(), config) as run:
        problem, start = run.problem, run.problem.env.reset()
    yield from pictures_of(problem, start, [Moment(start.configuration, start.poses)])


def pictures_of(problem: Problem, start: State, moments: Iterable[Moment]) -> Iterator[Image.Image]:
    """What is to be seen in these moments."""
    stage = open_stage(problem.domain, problem.instance, problem.options, start, "a picture")
    try:
        for moment in moments:
            stage.show(moment)
            pixels = stage.picture(WIDTH * OVERSAMPLING, HEIGHT * OVERSAMPLING)
            yield Image.fromarray(pixels).resize((WIDTH, HEIGHT), Image.Resampling.LANCZOS)
    finally:
        stage.close()


if __name__ == "__main__":
    main(sys.argv[1:] or (*RUNS, *STARTS))
