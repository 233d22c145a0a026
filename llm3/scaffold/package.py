"""From a name and a kind to the files of a package."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path, PurePosixPath

import jinja2

from llm3.errors import LLM3Error, OutputExists, UsageError
from llm3.scaffold.kinds import WORDS, Kind
from llm3.scaffold.name import Name

COMMON = "common"
"""The folder of the templates that all kinds share."""


def render(kind: Kind, name: Name) -> Mapping[PurePosixPath, str]:
    """The text of every file of a new package, by its place in the package's folder.

    What ends in ``.jinja`` is a template; other files are taken as they are, such as a prompt, which is a template
    itself.

    Raises:
        UsageError: llm3 uses the name itself where such a plugin is named.
    """
    if name.plugin in (*WORDS, *kind.used):
        raise UsageError(
            f"llm3 uses {name.plugin!r} itself where a {kind.registered} is named: choose another name, such as "
            f"my-{kind.registered}."
        )
    loader = jinja2.PackageLoader("llm3.scaffold")
    environment = jinja2.Environment(
        loader=loader,
        undefined=jinja2.StrictUndefined,
        autoescape=False,  # noqa: S701  # Python and TOML, not HTML
        keep_trailing_newline=True,
    )
    fields = {
        "name": name.plugin,
        "identifier": name.identifier,
        "module": name.module,
        "distribution": name.distribution,
        "title": name.title,
        "description": kind.description,
        "notes": f"notes/{kind.templates}.md.jinja",
        "trial": kind.trial.replace("NAME", name.plugin),
        "tried": kind.tried,
        "checked": kind.checked.replace("NAME", name.plugin),
    }
    files: dict[PurePosixPath, str] = {}
    for template in loader.list_templates():
        folder, _, place = template.partition("/")
        if folder in (COMMON, kind.templates):
            if template.endswith(".jinja"):
                files[name.file(place)] = environment.get_template(template).render(fields)
            else:
                files[name.file(place)] = loader.get_source(environment, template)[0]
    return files


def write(files: Mapping[PurePosixPath, str], folder: Path) -> None:
    """Write files into a folder that is new, or empty.

    Args:
        files: Their texts by their places in the folder.
        folder: Where they go.

    Raises:
        OutputExists: Something is there already.
        LLM3Error: The folder, or a file, cannot be written.
    """
    try:
        if folder.exists() and not (folder.is_dir() and not any(folder.iterdir())):
            raise OutputExists(f"'{folder}' is there already, and nothing is overwritten: choose another with --out.")
        for place, text in files.items():
            file = folder / place
            file.parent.mkdir(parents=True, exist_ok=True)
            with file.open("x", encoding="utf-8", newline="\n") as new:
                new.write(text)
    except OSError as error:
        raise LLM3Error(f"'{error.filename or folder}' cannot be written: {error.strerror or error}.") from error
