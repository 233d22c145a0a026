"""The ways into the manual: its first page, and the page for contributors."""

from __future__ import annotations

import re

from docs_pages import DOCS, ROOT, blocks, names, page, table

CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
LINK = re.compile(r"\{doc}`(?:[^`<]*<)?([\w-]+)>?`")


def test_every_page_is_told_of_on_the_first_page_and_is_in_the_table_of_contents():
    pages = {file.stem for file in DOCS.glob("*.md")} - {"index"}
    (contents,) = blocks(page("index"), "{toctree}")
    assert sorted(line for line in contents.text.splitlines() if re.fullmatch(r"[\w-]+", line)) == sorted(pages)
    assert set(LINK.findall(page("index"))) == pages


def test_every_link_between_pages_leads_somewhere():
    for file in DOCS.glob("*.md"):
        text = file.read_text(encoding="utf-8")
        for name in LINK.findall(text):
            assert (DOCS / f"{name}.md").is_file(), f"{file.name}: {name}"
        for name in re.findall(r"\{ref}`(?:[^`<]*<)?([\w-]+)>?`", text):
            assert any(f"({name})=" in other.read_text(encoding="utf-8") for other in DOCS.glob("*.md")), name


def test_each_of_three_kinds_of_people_has_a_first_page():
    rows = table(page("index"), "Where to begin").rows
    first = [LINK.match(row[1])[1] for row in rows]
    assert len(set(first)) == len(rows) == 3


def test_every_place_that_belongs_to_a_change_is_there():
    rows = table(CONTRIBUTING, "What belongs together").rows
    places = [name for row in rows for cell in row[1:] for name in names(cell) if "/" in name and " " not in name]
    assert len(places) > 30
    for place in places:
        assert (ROOT / place).exists(), place
    assert [row[0] for row in rows if row[0]] == [
        "a kind of failure",
        "a method of Env",
        "a setting of a domain",
        "an option of a run",
        "an event",
        "a rule of the kit",
    ]
