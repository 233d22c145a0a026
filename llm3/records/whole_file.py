"""Files that are there as a whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path

ENDING = ".new"


def write_whole(path: Path, content: str | bytes) -> None:
    """Write a file beside its place and move it there: whoever is killed leaves the old file or the new one.

    Links are followed. What stands there and is no file, such as a pipe or a device, is written to as it is.
    """
    data = content.encode() if isinstance(content, str) else content
    place = Path(os.path.realpath(path))
    if place.exists() and not place.is_file():
        place.write_bytes(data)
        return
    beside = place.with_name(f"{place.name}.{os.getpid()}{ENDING}")
    try:
        beside.write_bytes(data)  # a killed process of this number may have left one
        beside.replace(place)
    except OSError:
        beside.unlink(missing_ok=True)
        raise


def is_beside(path: Path, name: str) -> bool:
    """Whether this is what a killed process left beside a file of this name."""
    return path.name.startswith(f"{name}.") and path.name.endswith(ENDING)
