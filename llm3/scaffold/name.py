"""The name of a new plugin, and the names that follow from it."""

from __future__ import annotations

import keyword
import re
from dataclasses import dataclass
from pathlib import PurePosixPath

from llm3.errors import UsageError

LONGEST = 24
"""Letters of a name: longer ones would break the lines of the new package."""


@dataclass(frozen=True)
class Name:
    """What a plugin is called on the command line, such as ``my-rooms``."""

    plugin: str

    def __post_init__(self) -> None:
        """Check it.

        Raises:
            UsageError: It is no name for a Python package.
        """
        if not re.fullmatch(r"[a-z][a-z0-9]*([-_][a-z0-9]+)*", self.plugin) or len(self.plugin) > LONGEST:
            raise UsageError(
                f"a plugin's name is at most {LONGEST} lower-case letters and digits, a letter first, with single - or "
                f"_ between them, such as my-rooms: not {self.plugin!r}."
            )
        if self.plugin.startswith("test"):
            raise UsageError(
                f"pytest takes classes that begin with Test for tests: choose another name, not {self.plugin!r}."
            )
        if keyword.iskeyword(self.identifier):
            raise UsageError(f"{self.plugin!r} is a word of Python itself: choose another name, such as my-rooms.")

    @property
    def identifier(self) -> str:
        """As part of Python names: ``my_rooms``."""
        return self.plugin.replace("-", "_")

    @property
    def module(self) -> str:
        """What is imported: ``llm3_my_rooms``."""
        return f"llm3_{self.identifier}"

    @property
    def distribution(self) -> str:
        """What pip installs: ``llm3-my-rooms``."""
        return f"llm3-{self.identifier}".replace("_", "-")

    @property
    def title(self) -> str:
        """How its classes begin: ``MyRooms``."""
        return "".join(word.capitalize() for word in self.identifier.split("_"))

    def file(self, template: str) -> PurePosixPath:
        """Where the text of a template goes, such as ``llm3_my_rooms/env.py`` for ``MODULE/env.py.jinja``."""
        path = template.replace("MODULE", self.module).replace("NAME", self.identifier)
        return PurePosixPath(path.removesuffix(".jinja"))
