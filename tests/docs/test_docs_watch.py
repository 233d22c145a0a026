from __future__ import annotations

import re

from docs_pages import blocks, names, page, table

from llm3.cli.main import build_parser, main
from llm3.playback.frames import STANDSTILL
from llm3.types import PACE


def test_the_commands_make_the_film_that_the_page_tells_of(corridor, capsys):
    first, report, film = [
        line
        for block in blocks(page("watch"), "console")
        for line in re.findall(r"^\$ llm3 (.*)$", block.text, re.MULTILINE)
        if "--gui" not in line
    ]
    assert main(first.split()) == 0
    capsys.readouterr()
    assert main([*report.split(), "--small"]) == 0
    assert capsys.readouterr().out == "runs/clutter/report.html\n"
    assert main([*film.split(), "--size", "64x48", "--rate", "1"]) == 0
    assert capsys.readouterr().out == "clutter.gif\n"
    assert (corridor / "clutter.gif").read_bytes().startswith(b"GIF89a")


def test_the_table_has_every_flag_that_decides_what_is_drawn():
    told = {
        name.split()[0]
        for row in table(page("watch"), "As a film, as a picture, or in three dimensions").rows
        for name in names(row[0])
    }
    flags = {flag for flag in build_parser("render")._option_string_actions if flag.startswith("--")}
    assert told == flags - {"--help", "--debug", "--force", "--quiet"}


def test_the_figures_are_those_of_the_code():
    text = " ".join(page("watch").split())
    assert f"the fastest joint moves at {PACE:g} rad or {PACE:g} m a second" in text
    assert f"stands still for {STANDSTILL:g} s" in text
