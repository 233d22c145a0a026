"""Writes the rules of the conformance kit into rules.md, between the markers that are there.

Run it after a change of a rule; a test compares the page with the rules::

    python docs/rules.py
"""

from __future__ import annotations

from pathlib import Path

from llm3.testing.conformance.laws import Law, laws

PAGE = Path(__file__).with_name("rules.md")
BEGIN = "<!-- rules: written by docs/rules.py -->\n"
END = "<!-- end of rules -->\n"


def with_rules(page: str) -> str:
    """The page with the rules that there are in their place."""
    before, _, rest = page.partition(BEGIN)
    _, _, after = rest.partition(END)
    sections = "\n".join(section(kind, of_kind) for kind, of_kind in laws().items())
    return f"{before}{BEGIN}\n{sections}\n{END}{after}"


def section(kind: str, of_kind: tuple[Law, ...]) -> str:
    """The rules for one kind of plugin."""
    rows = "".join(f"| {law.name} | {law.text} |\n" for law in of_kind)
    return f"## {kind.capitalize()}\n\n| rule | what is so |\n|---|---|\n{rows}"


if __name__ == "__main__":
    PAGE.write_text(with_rules(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
