"""How Sphinx builds the documentation: ``sphinx-build -W -n docs OUT``. Nothing is fetched while it builds."""

from __future__ import annotations

import dataclasses
from importlib import metadata
from typing import Any

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.ext.napoleon import GoogleDocstring

project = "llm3"
author = "The llm3 authors"
project_copyright = author
version = release = metadata.version("llm3")

extensions = ["myst_parser", "sphinx.ext.autodoc"]
exclude_patterns = ["_build"]
html_theme = "furo"
html_title = f"llm3 {release}"
html_show_copyright = False

myst_enable_extensions = ["deflist"]
myst_heading_anchors = 3

default_role = "code"  # `name` in a docstring is code
autodoc_member_order = "bysource"
autodoc_preserve_defaults = True
autodoc_typehints_format = "short"
python_use_unqualified_type_names = True
autodoc_type_aliases = {
    **{name: f"llm3.types.{name}" for name in ("Fact", "Mask", "Observer", "RunEvent", "Vector", "Waypoints")},
    "Options": "llm3.interfaces.Options",
}

nitpicky = True
nitpick_ignore_regex = [
    (r"py:.*", r"(?!llm3).*"),  # other projects' names cannot be looked up without a network; ours must all resolve
    (r"py:.*", r"llm3\.(types\.frozen\.[KV]|jsonio\.T)"),  # type variables
]
suppress_warnings = ["ref.python"]  # the builtin `object` is taken for either of two fields of that name


PLAIN = (str, int, float, tuple, type(None))
LONGEST_DEFAULT = 40


def setup(app: Sphinx) -> None:
    """Read docstrings in Google's style, and write dataclasses so that they can be read."""
    app.connect("autodoc-process-docstring", _google_style)
    app.connect("autodoc-process-signature", _short_signature)
    app.connect("doctree-read", _drop_long_defaults)


def _google_style(_app: Sphinx, what: str, _name: str, _obj: Any, _options: Any, lines: list[str]) -> None:
    # napoleon as an extension would read the docstring of a field up to its first colon as the field's type.
    if what not in ("attribute", "data", "property"):
        lines[:] = GoogleDocstring(list(lines), what=what).lines()


def _short_signature(
    _app: Sphinx, what: str, _name: str, obj: Any, _options: Any, signature: str | None, returns: str | None
) -> tuple[str | None, str | None]:
    """The fields of a dataclass by name; their types stand below it."""
    if what != "class" or not dataclasses.is_dataclass(obj):
        return signature, returns
    return f"({', '.join(map(_shown, dataclasses.fields(obj)))})", None


def _shown(field: dataclasses.Field[Any]) -> str:
    if field.default is field.default_factory is dataclasses.MISSING:
        return field.name
    return f"{field.name}={field.default!r}" if isinstance(field.default, PLAIN) else f"{field.name}=..."


def _drop_long_defaults(_app: Sphinx, doctree: nodes.document) -> None:
    """A default that fills a line, such as all counts of a Stats, tells less than its type beside it."""
    for annotation in list(doctree.findall(addnodes.desc_annotation)):
        text = annotation.astext()
        if text.startswith(" = ") and len(text) > LONGEST_DEFAULT:
            annotation.parent.remove(annotation)
