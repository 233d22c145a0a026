"""Arrays in a zip archive, as numpy has them: no pickle, and no more memory than a file may take."""

from __future__ import annotations

import io
import math
import warnings
import zipfile
import zlib
from collections.abc import Mapping, Sequence
from tokenize import TokenError
from typing import Any

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

MOST_BYTES = 256 * 2**20
"""Of all arrays together: an archive of some kilobytes may be blown up to anything."""

LAST = 0x10FFFF
"""The number of the last character that there is."""


def packed(arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """The arrays as a compressed .npz file: equal arrays give equal bytes."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w") as archive:
        for name, array in arrays.items():
            stream = io.BytesIO()
            npy.write_array(stream, array, version=(1, 0), allow_pickle=False)
            archive.writestr(zipfile.ZipInfo(f"{name}.npy"), stream.getvalue(), zipfile.ZIP_DEFLATED)
    return content.getvalue()


def read_arrays(content: bytes, names: Sequence[str]) -> Mapping[str, NDArray[Any]]:
    """The arrays of a .npz file.

    Args:
        content: The file's bytes.
        names: Of all arrays that there must be.

    Raises:
        ValueError: It is no such file, holds other arrays, or they are too large.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            members = archive.infolist()
            if sorted(member.filename for member in members) != sorted(f"{name}.npy" for name in names):
                there = ", ".join(member.filename.removesuffix(".npy") for member in members) or "none"
                raise ValueError(f"the arrays are {there}, and should be {', '.join(names)}")
            size = sum(member.file_size for member in members)
            if size > MOST_BYTES:
                raise ValueError(f"the arrays have {size} bytes, and at most {MOST_BYTES} are read")
            return {member.filename.removesuffix(".npy"): _array(archive, member) for member in members}
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, OSError, RuntimeError) as error:
        raise ValueError(f"not a whole .npz file: {error}") from error


def _array(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> NDArray[Any]:
    if member.compress_type not in (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED):
        raise ValueError(f"{member.filename} is compressed in a way that numpy does not use")
    stream = io.BytesIO(archive.read(member))
    try:
        version = npy.read_magic(stream)
        if version != (1, 0):
            raise ValueError(f"version {version[0]}.{version[1]} of the .npy format, and 1.0 is read")
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # numpy warns of headers that it has to guess at
            shape, by_column, dtype = npy.read_array_header_1_0(stream)
        if dtype.hasobject or dtype.kind not in "Uif" or not dtype.itemsize:
            raise ValueError(f"the dtype {dtype}, and texts and numbers are read")
        rest = stream.read()
        if any(side < 0 for side in shape) or math.prod(shape) * dtype.itemsize != len(rest):
            raise ValueError(f"{len(rest)} bytes, and the shape {shape} of {dtype} needs others")
        if dtype.kind == "U" and (np.frombuffer(rest, np.dtype("u4").newbyteorder(dtype.byteorder)) > LAST).any():
            raise ValueError("a text holds what is no character")
        return np.frombuffer(rest, dtype).reshape(shape, order="F" if by_column else "C")
    except (Warning, TokenError) as error:
        raise ValueError(f"{member.filename}: its header is not as numpy writes it") from error
    except (ValueError, TypeError, SyntaxError, RecursionError, MemoryError, OverflowError) as error:
        raise ValueError(f"{member.filename}: {error}") from error
