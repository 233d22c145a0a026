"""Prompt strategies."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Strategy:
    """How the model is asked: a Jinja template inside an installed package.

    The template sees the fields of :class:`llm3.types.Context` and writes each chat message between
    ``{% call message("system") %}`` (or ``"user"``, or ``"assistant"``) and ``{% endcall %}``. It may include any file
    of its own package as ``<package>/<file>`` and the shipped partials as ``llm3_templates/partials/<file>``.
    """

    package: str
    """The import name of the package that ships the template."""
    template: str
    """The file, relative to the package's folder, such as ``"backtrack.j2"``."""
    description: str = ""
    """One line for ``llm3 list``."""
    fixed_sequence: bool = False
    """Whether the domain's skeleton gives the actions, and the model chooses their parameters only."""
