"""Writes what is told of the code as it is into pages of the manual, between the markers that are there.

Run it after a change of the command line or of a rule of the kit; a test compares the pages with the code::

    python docs/written.py
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from llm3.cli.main import COMMANDS, build_parser
from llm3.testing.conformance.laws import laws

BEGIN = "<!-- written by docs/written.py -->\n"
END = "<!-- end of what is written -->\n"


def commands() -> str:
    """Every command's heading and help."""
    return "\n".join(
        f"### llm3 {command}\n\n```text\n{build_parser(command).format_help()}```\n" for command in COMMANDS
    )


def rules() -> str:
    """The rules for each kind of plugin."""
    sections = []
    for kind, of_kind in laws().items():
        rows = "".join(f"| {law.name} | {law.text} |\n" for law in of_kind)
        sections.append(f"## {kind.capitalize()}\n\n| rule | what is so |\n|---|---|\n{rows}")
    return "\n".join(sections)


PAGES: Mapping[str, Callable[[], str]] = MappingProxyType({"command-line.md": commands, "rules.md": rules})
"""By the page, what is written into it."""


def rewritten(page: str, name: str) -> str:
    """The text of a page with what is written in its place."""
    before, _, rest = page.partition(BEGIN)
    _, _, after = rest.partition(END)
    return f"{before}{BEGIN}\n{PAGES[name]()}\n{END}{after}"


if __name__ == "__main__":
    for name in PAGES:
        file = Path(__file__).with_name(name)
        file.write_text(rewritten(file.read_text(encoding="utf-8"), name), encoding="utf-8")
