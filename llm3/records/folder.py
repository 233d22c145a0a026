"""Where a run's record goes."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from llm3.errors import LLM3Error, OutputExists

RECORD_FILES = ("run.json", "events.jsonl", "plan.json")


def default_folder(name: str, now: datetime, parent: Path = Path("runs")) -> Path:
    """A folder under `parent` that does not exist yet, named by the time and by what was run."""
    stem = f"{now:%Y%m%d-%H%M%S}-{name}"
    folder, count = parent / stem, 1
    while folder.exists():
        count += 1
        folder = parent / f"{stem}-{count}"
    return folder


def create_folder(folder: Path, force: bool = False) -> Path:
    """Make the folder, or empty it of an earlier record if `force`; other files in it are left alone.

    Raises:
        OutputExists: It holds something already, and `force` is not given.
        LLM3Error: It cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.iterdir()) and not force:
            raise OutputExists(f"the output folder '{folder}' is not empty: choose another, or give --force.")
        for name in RECORD_FILES:
            (folder / name).unlink(missing_ok=True)
    except OSError as error:
        raise LLM3Error(f"the output folder '{folder}' cannot be written: {error.strerror or error}.") from error
    return folder
