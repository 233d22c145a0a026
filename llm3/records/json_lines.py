"""Files of one JSON object per line, which are readable at every moment of their making."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from llm3.errors import InputError
from llm3.jsonio import loads, unsorted


@dataclass(frozen=True)
class Header:
    """The first line."""

    format: str


class LineWriter:
    """Writes lines, each of them flushed at once. Close it."""

    def __init__(self, path: Path, format_: str, force: bool = True, go_on: bool = False) -> None:
        """Begin the file with its header, or go on where it ends.

        Args:
            path: The file.
            format_: What its header says.
            force: Whether to begin anew where there is such a file.
            go_on: Whether to keep the file's lines; one at its end that was cut off, as by a kill, is removed.

        Raises:
            FileExistsError: There is such a file, and neither `force` nor `go_on` is given.
        """
        if go_on and path.exists():
            _mend_end(path)
            self._file = path.open("a", encoding="utf-8")
        else:
            self._file = path.open("w" if force or go_on else "x", encoding="utf-8")
        if not path.stat().st_size:
            self.write(Header(format_))

    def write(self, value: Any) -> None:
        """Write one line."""
        self._file.write(unsorted(value) + "\n")
        self._file.flush()

    def close(self) -> None:
        """Close the file. Calling it twice does no harm."""
        self._file.close()


def read_lines(path: Path, format_: str) -> Iterator[tuple[str, bytes]]:
    """Each line after the header, and where it stands.

    A last line that was cut off, as by a kill, is left out. A header may stand again between the lines, so that files
    can be joined; what was cut off before it is left out as well.

    Raises:
        InputError: The file cannot be read, or it is of another format.
    """
    try:
        *whole, last = path.read_bytes().split(b"\n")
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from error
    header = unsorted(Header(format_)).encode()
    if _is_json(last) or not (whole or header.startswith(last)):
        whole.append(last)
    for number, text in enumerate(whole, start=1):
        source = f"{path}, line {number}"
        if text.endswith(header) and not _is_json(text):
            continue
        if number == 1 or _is_header(text):
            stated = loads(text, Header, source).format
            if stated != format_:
                raise InputError(f"{source}: the format is {stated!r}, and this version reads {format_!r}")
        else:
            yield source, text


def _mend_end(path: Path) -> None:
    """Let a file end with a whole line: a last one that was cut off is removed, and one without its end gets that."""
    lines, newline, last = path.read_bytes().rpartition(b"\n")
    with path.open("r+b") as file:
        if _is_json(last):
            file.seek(0, os.SEEK_END)
            file.write(b"\n")
        else:
            file.truncate(len(lines) + len(newline))


def _is_header(text: bytes) -> bool:
    return text.startswith(b'{"format":')


def _is_json(text: bytes) -> bool:
    try:
        json.loads(text)
    except (ValueError, RecursionError):
        return False
    return True


def plain(text: bytes, source: str) -> Mapping[str, Any]:
    """A line as dicts, lists and the like.

    Raises:
        InputError: It is no JSON object.
    """
    return loads(text, dict[str, Any], source)
