"""The files that a program can be written to, and read from."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from llm3.errors import InputError, UsageError
from llm3.export.csv_table import read_csv, write_csv
from llm3.export.npz_arrays import read_npz, write_npz
from llm3.export.program import Program
from llm3.export.ros2_json import read_ros2_json, write_ros2_json

MOST_BYTES = 256 * 2**20
"""A file that is larger is not read."""


@dataclass(frozen=True)
class Format:
    """How programs are kept in a file."""

    ending: str
    """Of the file's name."""
    write: Callable[[Program, bool], bytes]
    """Takes the program, and whether readers will be given accelerations to follow."""
    read: Callable[[bytes, str], Program]
    """Takes the file's bytes and its name."""


FORMATS: Mapping[str, Format] = MappingProxyType(
    {
        "ros2-json": Format(".json", write_ros2_json, read_ros2_json),
        "csv": Format(".csv", lambda program, _: write_csv(program), read_csv),
        "npz": Format(".npz", lambda program, _: write_npz(program), read_npz),
    }
)
"""By name."""


def write_program(program: Program, name: str, with_accelerations: bool = False) -> bytes:
    """What a file of a format holds.

    Args:
        program: What is to be done.
        name: Of the format, one of `FORMATS`.
        with_accelerations: Whether the messages of ``ros2-json`` tell accelerations, of which a controller makes
            quintics; see :func:`llm3.export.resampled`. The other formats tell them always.

    Raises:
        UsageError: There is no such format.
    """
    if name not in FORMATS:
        raise UsageError(f"unknown format {name!r}. Known: {', '.join(FORMATS)}.")
    return FORMATS[name].write(program, with_accelerations)


def read_program(path: Path) -> Program:
    """Read a program from a file, whose ending tells the format.

    Raises:
        UsageError: The ending is none of them.
        InputError: The file cannot be read, or does not have the documented form.
    """
    form = FORMATS[format_of(path)]
    try:
        with path.open("rb") as file:
            content = file.read(MOST_BYTES + 1)
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from error
    if len(content) > MOST_BYTES:
        raise InputError(f"{path}: more than {MOST_BYTES} bytes")
    return form.read(content, str(path))


def format_of(path: Path) -> str:
    """The format that the ending of a file's name tells.

    Raises:
        UsageError: None.
    """
    for name, form in FORMATS.items():
        if path.suffix.lower() == form.ending:
            return name
    endings = ", ".join(f"{form.ending} ({name})" for name, form in FORMATS.items())
    raise UsageError(f"'{path}' has none of the endings {endings}.")
