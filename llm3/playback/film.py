"""Writes pictures one after another into a file: a GIF, or an MP4 where the program ffmpeg is there."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterable, Iterator
from contextlib import suppress
from importlib.util import find_spec
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

from llm3.errors import LLM3Error, MissingDependency, UsageError
from llm3.interfaces import Picture

if TYPE_CHECKING:
    from PIL import Image

KINDS = (".gif", ".mp4", ".png")


def check_kind(file: Path) -> None:
    """See that a file of this name can be written here.

    Raises:
        UsageError: Its ending is none of `KINDS`.
        MissingDependency: What writes it is not installed.
    """
    if file.suffix.lower() not in KINDS:
        raise UsageError(f"'{file}' must end in {', '.join(KINDS)} or .html: that decides what is written.")
    if find_spec("PIL") is None:
        raise MissingDependency("pictures need Pillow, which is not installed: pip install 'llm3[viz]'.")
    if file.suffix.lower() == ".mp4" and not shutil.which("ffmpeg"):
        raise MissingDependency("an .mp4 needs the program ffmpeg, which is not installed: write a .gif instead.")


def write_picture(picture: Picture, file: Path) -> None:
    """Write one picture as a PNG.

    Raises:
        LLM3Error: The file cannot be written.
    """
    from PIL import Image

    try:
        Image.fromarray(picture).save(file, optimize=True)
    except OSError as error:
        raise _unwritten(file, error) from error


def write_film(pictures: Iterable[Picture], file: Path, rate: float) -> None:
    """Write pictures as a film; one that breaks off leaves no file.

    Args:
        pictures: At least one, all of one size; for an MP4 its sides are even numbers.
        file: Its ending decides what is written.
        rate: How many pictures a second; a GIF's are shown for whole hundredths of a second.

    Raises:
        LLM3Error: The file cannot be written.
    """
    write = _write_mp4 if file.suffix.lower() == ".mp4" else _write_gif
    beside = file.with_name(f"{file.stem}.new{file.suffix}")
    try:
        write(iter(pictures), beside, rate)
        beside.replace(file)
    except OSError as error:
        raise _unwritten(file, error) from error
    finally:
        with suppress(OSError):  # where nothing can be written, nothing can be left
            beside.unlink(missing_ok=True)


def _write_gif(pictures: Iterator[Picture], file: Path, rate: float) -> None:
    images = map(_with_palette, pictures)
    next(images).save(file, save_all=True, append_images=images, duration=max(20, round(1000 / rate, -1)), loop=0)


def _with_palette(picture: Picture) -> Image.Image:
    from PIL import Image

    return Image.fromarray(picture).quantize(64, dither=Image.Dither.NONE)


def _write_mp4(pictures: Iterator[Picture], file: Path, rate: float) -> None:
    first = next(pictures)
    height, width, _ = first.shape
    command = ["ffmpeg", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24"]
    command += ["-s", f"{width}x{height}", "-r", f"{rate:g}", "-i", "-", "-pix_fmt", "yuv420p", str(file)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as ffmpeg:  # noqa: S603  # no shell
        assert ffmpeg.stdin  # noqa: S101  # it is a pipe
        assert ffmpeg.stderr  # noqa: S101  # as well
        try:
            for picture in chain((first,), pictures):
                ffmpeg.stdin.write(picture.tobytes())
            ffmpeg.stdin.close()
        except BrokenPipeError:
            pass  # it ended early, and says why
        except BaseException:
            ffmpeg.kill()
            raise
        said = ffmpeg.stderr.read().decode(errors="replace")
    if ffmpeg.returncode:
        raise LLM3Error(f"ffmpeg cannot write '{file}': {said.strip() or f'exit code {ffmpeg.returncode}'}")


def _unwritten(file: Path, error: OSError) -> LLM3Error:
    return LLM3Error(f"'{file}' cannot be written: {error.strerror or error}.")
