"""Files that are there as a whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path

ENDING = ".new"


def write_whole(path: Path, content: str | bytes) -> None:
    """Write a file beside its place and move it there: whoever is killed leaves the old file or the new one."""
    beside = path.with_name(f"{path.name}.{os.getpid()}{ENDING}")
    try:
        # A killed process of this number may have left one.
        beside.write_bytes(content.encode() if isinstance(content, str) else content)
        beside.replace(path)
    except OSError:
        beside.unlink(missing_ok=True)
        raise


def is_beside(path: Path, name: str) -> bool:
    """Whether this is what a killed process left beside a file of this name."""
    return path.name.startswith(f"{name}.") and path.name.endswith(ENDING)
