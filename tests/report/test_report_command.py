"""`llm3 report`: where the page goes, what is said of it, and what it refuses."""

from __future__ import annotations

import os
import shutil

import pytest
from reported import read_page

CLUTTER = "--domain tabletop2d --setting clutter --seed 1 --timing none --quiet"
SMALL = "report here --small"


@pytest.fixture
def run(command):
    """A solved run in the folder ``here``."""
    assert command(f"{CLUTTER} --out here").code == 0


@pytest.fixture
def experiment(command):
    """An experiment of one method and one problem in the folder ``there``."""
    one = "--attempts 2 --problem clutter --method offline --set budgets.motion_calls=[10,500]"
    assert command(f"experiment tabletop2d {one} --quiet --out there").code == 0


def test_the_page_stands_in_the_runs_folder_and_its_name_is_the_result(run, command, cwd):
    ended = command(SMALL)
    assert (ended.code, ended.out, ended.err) == (0, "here/report.html\n", "")
    assert read_page((cwd / "here" / "report.html").read_text(encoding="utf-8"))
    assert command(SMALL).code == 0  # a report is written anew


def test_another_file_is_not_overwritten_without_force(run, command, cwd):
    (cwd / "mine.html").write_text("mine")
    ended = command(f"{SMALL} --out mine.html")
    assert (ended.code, ended.out) == (2, "")
    assert ended.err == "llm3: error: 'mine.html' exists: choose another file, or give --force.\n"
    assert (cwd / "mine.html").read_text() == "mine"
    assert command(f"{SMALL} --out mine.html --force").out == "mine.html\n"
    assert "</html>" in (cwd / "mine.html").read_text()


def test_what_is_not_installed_is_said_on_the_page_and_on_stderr(run, command, cwd, monkeypatch):
    monkeypatch.setattr("llm3.playback.replay.find_spec", lambda name: None)
    ended = command("report here")
    sentence = "a replay needs viser, which is not installed: pip install 'llm3[viz]'."
    assert (ended.code, ended.err) == (0, f"{sentence}\n")
    page = read_page((cwd / "here" / "report.html").read_text(encoding="utf-8"))
    assert next(note.text for note in page.classed("note")) == f"Something is missing in this report: {sentence}"
    assert command("report here --quiet").err == ""


@pytest.mark.parametrize(
    ("line", "code", "sentence"),
    [
        ("report nowhere", 3, "nowhere: No such file or directory"),
        (
            "report .",
            3,
            "'.' holds neither run.json nor experiment.json: it is no folder of a run or an experiment.",
        ),
        (f"{SMALL} --out nowhere/page.html", 3, "'nowhere/page.html' cannot be written: No such file or directory."),
    ],
    ids=["no folder", "no record", "no place"],
)
def test_one_line_says_what_is_wrong(run, command, line, code, sentence):
    ended = command(line)
    assert (ended.code, ended.out, ended.err) == (code, "", f"llm3: error: {sentence}\n")


def test_a_plan_without_a_record_is_no_run_and_the_line_says_what_draws_it(run, command, cwd):
    (cwd / "alone").mkdir()
    (cwd / "alone" / "plan.json").write_bytes((cwd / "here" / "plan.json").read_bytes())
    ended = command("report alone/plan.json")
    reason = "'alone' holds neither run.json nor experiment.json: it is no folder of a run or an experiment."
    assert (ended.code, ended.err) == (3, f"llm3: error: {reason} 'llm3 render' draws 'alone/plan.json' by itself.\n")


def test_a_damaged_record_is_one_line_and_loses_no_earlier_report(run, command, cwd):
    command(SMALL)
    before = (cwd / "here" / "report.html").read_bytes()
    with (cwd / "here" / "events.jsonl").open("a") as file:
        file.write('{"event": "Nonsense"}\n')
    ended = command(SMALL)
    assert (ended.code, ended.out, ended.err.count("\n")) == (3, "", 1)
    assert "unknown event 'Nonsense'" in ended.err
    assert (cwd / "here" / "report.html").read_bytes() == before


def test_a_run_that_was_cut_off_before_it_began_has_a_report_all_the_same(run, command, cwd):
    lines = (cwd / "here" / "events.jsonl").read_text().splitlines(keepends=True)
    (cwd / "here" / "events.jsonl").write_text(lines[0])
    assert command("report here").code == 0
    page = read_page((cwd / "here" / "report.html").read_text(encoding="utf-8"))
    remarks = [note.text for note in page.classed("note")]
    assert remarks[0] == "The record is damaged: run.json says 'solved', and the events break off before the end."


def test_a_run_that_goes_on_is_told_by_its_last_attempt(run, command, cwd):
    text = (cwd / "here" / "run.json").read_text()
    (cwd / "here" / "run.json").write_text(text.replace('"status": "solved"', '"status": "running"'))
    assert command(SMALL).code == 0
    page = read_page((cwd / "here" / "report.html").read_text(encoding="utf-8"))
    remarks = [note.text for note in page.classed("note")]
    sentence = "The run had not ended when this was written, or it was killed: figures are those of its last attempt."
    assert remarks[0] == sentence


def test_a_file_of_the_folder_is_as_good_as_the_folder(run, command):
    assert command("report here/plan.json --small").out == "here/report.html\n"


def test_an_experiment_has_its_tables_and_a_link_to_each_run(experiment, command, cwd):
    ended = command("report there")
    assert (ended.code, ended.out) == (0, "there/report.html\n")
    page = read_page((cwd / "there" / "report.html").read_text(encoding="utf-8"))
    (runs,) = page.classed("runs")
    rows = [[cell.text for cell in row.all("td")] for body in runs.all("tbody") for row in body.all("tr")]
    assert [row[:4] for row in rows] == [["offline", "clutter", str(seed), "solved"] for seed in (0, 1)]
    links = [link.attributes["href"] for link in runs.all("a")]
    assert len(links) == 2
    for link in links:
        assert "tabletop2d" in read_page((cwd / "there" / link).read_text(encoding="utf-8")).text
    captions = [caption.text for caption in page.all("caption")]
    assert {"Every method", "Solved within a budget of motion calls"} <= set(captions)
    assert len(list(page.all("img"))) >= 3


def test_links_lead_from_wherever_the_page_is_put(experiment, command, cwd):
    (cwd / "pages").mkdir()
    assert command("report there --out pages/whole.html").code == 0
    page = read_page((cwd / "pages" / "whole.html").read_text(encoding="utf-8"))
    (runs,) = page.classed("runs")
    assert all((cwd / "pages" / link.attributes["href"]).exists() for link in runs.all("a"))


def test_reports_of_runs_are_made_anew_only_where_the_record_is_newer(experiment, command, cwd):
    command("report there --quiet")
    first, second = sorted((cwd / "there" / "records").rglob("report.html"))
    for page in (first, second):
        page.write_text("old")
    ahead = first.stat().st_mtime_ns + 10**9
    os.utime(first.with_name("run.json"), ns=(ahead, ahead))
    command("report there --quiet")
    assert first.read_text() != "old"
    assert second.read_text() == "old"


def test_a_small_report_of_an_experiment_links_to_what_is_there(experiment, command, cwd):
    assert command("report there --small").code == 0
    page = read_page((cwd / "there" / "report.html").read_text(encoding="utf-8"))
    (runs,) = page.classed("runs")
    assert list(runs.all("a")) == []
    shutil.rmtree(cwd / "there" / "records")
    assert command("report there").code == 0
