"""Connections to PyBullet: one client, one world, and nothing shared between two of them."""

from __future__ import annotations

import functools
import os
import platform
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType, TracebackType
from typing import Any

from llm3.errors import LLM3Error, MissingDependency


@contextmanager
def quiet() -> Iterator[None]:
    """Send what native code writes to the file descriptors 1 and 2 nowhere, for as long as the block lasts.

    Bullet prints banners and warnings from C, below `sys.stdout`, and a program whose output is read by another
    program cannot have that.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    saved = os.dup(1), os.dup(2)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        yield
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        for descriptor, original in zip((1, 2), saved, strict=True):
            os.dup2(original, descriptor)
        for descriptor in (*saved, nowhere):
            os.close(descriptor)


def require_pybullet() -> ModuleType:
    """Import PyBullet.

    Raises:
        MissingDependency: It is not installed.
    """
    try:
        with quiet():
            import pybullet
    except ImportError as error:
        python = f"{platform.python_implementation()} {platform.python_version()}"
        raise MissingDependency(
            "this needs PyBullet, which is not installed: its wheels exist for Linux x86-64 on CPython 3.9 to 3.11 "
            f"only, and this is {python} on {platform.system()} {platform.machine()}."
        ) from error
    return pybullet  # type: ignore[no-any-return]  # PyBullet ships no types


class BulletClient:
    """One PyBullet world, which it owns.

    Every function of the module ``pybullet`` is a method of the client, called without ``physicsClientId``::

        with connect() as client:
            client.setGravity(0, 0, -9.81)

    so that no call can reach another world by mistake. Constants, such as ``client.GEOM_BOX``, are there too.
    """

    def __init__(self, pybullet: ModuleType, identifier: int) -> None:
        """Own a connection that stands; see `connect`."""
        self._pybullet = pybullet
        self.id = identifier
        """The ``physicsClientId``."""
        self.is_open = True

    def __getattr__(self, name: str) -> Any:
        value = getattr(self._pybullet, name)
        if callable(value) and not isinstance(value, type):  # functions, but not the class of its errors
            value = functools.partial(value, physicsClientId=self.id)
        setattr(self, name, value)  # found without __getattr__ from now on
        return value

    def close(self) -> None:
        """Disconnect. Calling it twice does no harm."""
        if self.is_open:
            self.is_open = False
            with quiet():
                self._pybullet.disconnect(physicsClientId=self.id)

    def __enter__(self) -> BulletClient:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def connect(gui: bool = False) -> BulletClient:
    """Start a PyBullet world of its own.

    Args:
        gui: Open a window; without one, the world needs no screen.

    Raises:
        MissingDependency: PyBullet is not installed.
        LLM3Error: PyBullet cannot open a window, or has no room for another world.
    """
    pybullet = require_pybullet()
    if gui and not os.environ.get("DISPLAY"):  # PyBullet would end the process
        raise LLM3Error("PyBullet cannot open a window: DISPLAY is not set, so there is no screen to open it on.")
    with quiet():
        try:
            identifier = pybullet.connect(pybullet.GUI if gui else pybullet.DIRECT)
        except pybullet.error:
            identifier = -1
    if identifier < 0:
        raise LLM3Error(
            "PyBullet cannot open a window, or one is open already: it shows one world a process."
            if gui
            else "PyBullet has no room for another world: close one of the open ones."
        )
    return BulletClient(pybullet, identifier)
