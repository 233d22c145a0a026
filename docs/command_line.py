"""Writes the help of every command into command-line.md, between the markers that are there.

Run it after a change of the command line; a test compares the page with the live help::

    python docs/command_line.py
"""

from __future__ import annotations

from pathlib import Path

from llm3.cli.main import COMMANDS, build_parser

PAGE = Path(__file__).with_name("command-line.md")
BEGIN = "<!-- help: written by docs/command_line.py -->\n"
END = "<!-- end of help -->\n"


def with_help(page: str) -> str:
    """The page with the live help in its place."""
    before, _, rest = page.partition(BEGIN)
    _, _, after = rest.partition(END)
    sections = "\n".join(map(section, COMMANDS))
    return f"{before}{BEGIN}\n{sections}\n{END}{after}"


def section(command: str) -> str:
    """One command's heading and help."""
    return f"### llm3 {command}\n\n```text\n{build_parser(command).format_help()}```\n"


if __name__ == "__main__":
    PAGE.write_text(with_help(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
