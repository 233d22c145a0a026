"""From a template to a page: whatever a model wrote stays text."""

from __future__ import annotations

from typing import Any

import jinja2


def render(template: str, **fields: Any) -> str:
    """A whole HTML page.

    Args:
        template: The file's name in the folder templates.
        fields: What the template uses.
    """
    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("llm3.report"),
        undefined=jinja2.StrictUndefined,
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(template).render(**fields)
