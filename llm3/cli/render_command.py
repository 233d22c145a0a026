"""Make a film, a picture or a page to walk around in, of a plan or of what was carried out of an attempt."""

from __future__ import annotations

from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TextIO

from llm3.cli.output_file import check_free, write_file
from llm3.cli.problem_arguments import number, path, plan_name, whole
from llm3.cli.text import emit
from llm3.interfaces import Picture, Stage
from llm3.playback import Chapter, Frame, evenly, frames, open_scenery, open_stage, replay_page
from llm3.playback.film import check_kind, write_film, write_picture
from llm3.records import Played, read_played
from llm3.registry import Registry
from llm3.types import Moment, moment_of

PAGE = ".html"
SMOOTH = 25.0
"""How many moments a second a page shows."""
RATE = 60.0
"""How many moments a second are looked at for a single one."""
SIDES = range(16, 4001, 2)
"""What a side of a picture may be, in pixels: even numbers, as films need."""


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add = parser.add_argument
    rate, factor = partial(number, least=1.0, most=100.0), partial(number, least=0.1, most=100.0)
    seconds = partial(number, least=0.0, most=1e6)
    add("plan", type=path, metavar="PLAN", help="a plan.json, or the folder of a run")
    add(
        "--attempt",
        type=partial(whole, least=1, most=10**6),
        metavar="N",
        help="what was carried out of an attempt of the run, instead of the plan",
    )
    add(
        "--out",
        type=path,
        metavar="FILE",
        help="a .gif, .mp4, .png or .html (default: a .gif here, with the folder's name)",
    )
    add("--force", action="store_true", help="overwrite FILE")
    add("--size", type=_size, metavar="WxH", default=(480, 360), help="in pixels (default: 480x360)")
    add(
        "--rate",
        type=rate,
        metavar="N",
        default=10.0,
        help="pictures a second (default: 10)",
    )
    add(
        "--speed",
        type=factor,
        metavar="X",
        default=2.0,
        help="how many times as fast as the robot (default: 2)",
    )
    add(
        "--at",
        type=seconds,
        metavar="S",
        help="of a .png: seconds from the start of the motion (default: its end)",
    )
    add("--quiet", action="store_true", help="no progress on stderr")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    file = arguments.out or Path(f"{plan_name(arguments.plan)}.gif")
    if file.suffix.lower() != PAGE:
        check_kind(file)
    check_free(file, arguments.force)
    played = read_played(Registry.discover(), arguments.plan, arguments.attempt)
    if file.suffix.lower() == PAGE:
        _write_page(played, file, arguments.attempt)
        emit(f"{file}\n", out)
        return 0
    stage = open_stage(played.domain, played.instance, played.options, played.start, "llm3 render")
    try:
        if file.suffix.lower() == ".png":
            stage.show(_at(played, arguments.at))
            write_picture(stage.picture(*arguments.size), file)
        else:
            rate = arguments.rate / arguments.speed  # of the robot's own time
            shown = tuple(evenly(frames(played.start, played.steps, rate), rate))
            write_film(_pictures(stage, shown, arguments), file, arguments.rate)
    finally:
        stage.close()
    emit(f"{file}\n", out)
    return 0


def _write_page(played: Played, file: Path, attempt: int | None) -> None:
    scenery = open_scenery(played.domain, played.instance, played.options, "a page")
    moments = (frame.moment for frame in frames(played.start, played.steps, SMOOTH))
    title = "The plan" if attempt is None else f"Attempt {attempt}"
    write_file(file, replay_page(f"{played.domain.name} in three dimensions", scenery, [Chapter(title, moments)]))


def _pictures(stage: Stage, shown: Sequence[Frame], arguments: Namespace) -> Iterator[Picture]:
    from llm3.cli.progress_view import ProgressView  # rich takes a while to import

    with ProgressView("picture", len(shown), arguments.quiet) as view:
        for frame in shown:
            stage.show(frame.moment)
            yield stage.picture(*arguments.size)
            view.advance()


def _at(played: Played, seconds: float | None) -> Moment:
    """The last moment that is not later than this."""
    moment = moment_of(played.start)
    for frame in frames(played.start, played.steps, RATE):
        if seconds is not None and frame.moment.time > seconds:
            break
        moment = frame.moment
    return moment


def _size(text: str) -> tuple[int, int]:
    width, cross, height = text.partition("x")
    sides = [int(side) if side.isascii() and side.isdigit() and len(side) <= 4 else 0 for side in (width, height)]
    if not cross or not all(side in SIDES for side in sides):
        raise ArgumentTypeError(
            f"expected two even numbers from {SIDES[0]} to {SIDES[-1]}, such as 480x360, not {text!r}"
        )
    return sides[0], sides[1]
