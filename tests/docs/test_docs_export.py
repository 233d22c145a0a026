from __future__ import annotations

import csv
import io
import json
import re

import numpy as np
from docs_pages import blocks, names, page, table, tables

from llm3.cli.main import build_parser, main
from llm3.export import FORMATS, read_program, write_program
from llm3.export.limits import SAME
from llm3.export.resampling import ASIDE

PAGE = page("export")


def exported(corridor, capsys) -> str:
    """What the page's first commands print; the files are there after it."""
    (transcript,) = blocks(PAGE, "console")
    commands = re.findall(r"^\$ llm3 (.*)$", transcript.text, re.MULTILINE)
    assert main([*commands[0].split(), "--quiet"]) == 0
    capsys.readouterr()
    for command in commands[1:]:
        assert main(command.split()) == 0
    return capsys.readouterr().out


def test_the_commands_and_the_code_do_what_the_page_says(corridor, capsys):
    printed = exported(corridor, capsys)
    (transcript,) = blocks(PAGE, "console")
    assert printed == "".join(re.findall(r"^[^$].*\n", transcript.text, re.MULTILINE))
    code = blocks(PAGE, "python")[-1]
    exec(compile(code.text, "docs/export.md", "exec"), {})


def test_the_table_has_every_flag():
    flags = {flag for flag in build_parser("export")._option_string_actions if flag.startswith("--")}
    told = {name.split()[0] for row in table(PAGE, "Hand a plan over to a robot").rows for name in names(row[0])}
    assert told == flags - {"--help", "--debug", "--force"}
    (row,) = [row for row in table(PAGE, "Hand a plan over to a robot").rows if "--format" in row[0]]
    assert set(FORMATS) <= set(names(row[1]))


def test_every_field_column_and_array_of_a_file_is_told(corridor, capsys):
    exported(corridor, capsys)
    program = read_program(corridor / "plane.json")
    file = json.loads(write_program(program, "ros2-json"))
    top, kinds = (t for t in tables(PAGE) if t.heading == "ros2-json")
    assert set(top.names) == set(file)
    told = {name for row in kinds.rows for cell in row for name in names(cell)}
    told |= {"kind", "action", "text"}
    for item in file["items"]:
        assert set(item) <= told
    (header, *_) = csv.reader(io.StringIO(write_program(program, "csv").decode()))
    columns = {name for row in table(PAGE, "csv").rows for cell in row for name in names(cell)}
    for name in header:
        generic = re.sub(r"^[xy] (\w+) \[m", r"JOINT \1 [UNIT", name)
        assert generic in columns
    with np.load(io.BytesIO(write_program(program, "npz"))) as arrays:
        assert set(table(PAGE, "npz").names) == set(arrays)


def test_the_figures_are_those_of_the_code():
    text = " ".join(PAGE.split())
    assert f"to within {SAME} rad or m" in text
    assert f"no farther than {ASIDE} rad or m" in text
