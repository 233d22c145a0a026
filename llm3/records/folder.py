"""Where a run's record goes."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from llm3.errors import LLM3Error, OutputExists

RECORD_FILES = ("run.json", "events.jsonl", "plan.json")


def create_default_folder(name: str, now: datetime, parent: Path = Path("runs")) -> Path:
    """Make a new folder under `parent`, named by the time and by what is run; two runs never share one.

    Raises:
        LLM3Error: It cannot be made.
    """
    stem = f"{now:%Y%m%d-%H%M%S}-{name}"
    folder, count = parent / stem, 1
    while True:
        try:
            folder.mkdir(parents=True)
            return folder
        except FileExistsError:
            count += 1
            folder = parent / f"{stem}-{count}"
        except OSError as error:
            raise _unwritable(folder, error) from error


def create_folder(folder: Path, force: bool = False) -> Path:
    """Make the folder, or empty it of an earlier record if `force`; other files in it are left alone.

    Raises:
        OutputExists: It holds something already, and `force` is not given.
        LLM3Error: It cannot be made.
    """
    if folder.exists() and not folder.is_dir():
        raise OutputExists(f"'{folder}' is a file, not a folder: choose another.")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        if any(folder.iterdir()) and not force:
            raise OutputExists(f"the output folder '{folder}' is not empty: choose another, or give --force.")
        for name in RECORD_FILES:
            if (folder / name).is_dir():
                raise OutputExists(f"'{folder / name}' is a folder, so no record can be written there.")
        for name in RECORD_FILES:
            (folder / name).unlink(missing_ok=True)
    except OSError as error:
        raise _unwritable(folder, error) from error
    return folder


def _unwritable(folder: Path, error: OSError) -> LLM3Error:
    return LLM3Error(f"the output folder '{folder}' cannot be written: {error.strerror or error}.")
