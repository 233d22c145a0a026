"""`llm3 results` as a user runs it.

The snapshots in ``snapshots/`` are compared to the last character. After a wanted change of a table, write them anew
and read the difference before it is committed::

    LLM3_WRITE_SNAPSHOTS=1 pytest tests/results
"""

import csv
import io
import os
import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import pytest
from command_line import environment, llm3
from command_line import run as run_command
from experiment_folders import PAPER, budgets, capped, experiment, run, table1, table2, write

from llm3.experiments import Column, Group, Layout, read_experiment_folder
from llm3.results import as_csv, report, summarize

SNAPSHOTS = Path(__file__).parent / "snapshots"
WRITE = bool(os.environ.get("LLM3_WRITE_SNAPSHOTS"))
ENDINGS = {"text": "txt", "markdown": "md", "csv": "csv"}


@pytest.mark.parametrize("format_", ENDINGS)
@pytest.mark.parametrize("table", [table1, table2, budgets])
def test_snapshot(command, cwd, table, format_):
    ended = command("results", str(table(cwd / "done")), "--format", format_)
    path = SNAPSHOTS / f"{table.__name__}.{ENDINGS[format_]}"
    if WRITE:
        path.write_text(ended.out, encoding="utf-8")
    assert (ended.code, ended.err) == (0, "")
    assert ended.out == path.read_text(encoding="utf-8")


def test_every_snapshot_is_of_a_test():
    assert {path.name for path in SNAPSHOTS.iterdir()} == {
        f"{t}.{e}" for t in ("table1", "table2", "budgets") for e in ENDINGS.values()
    }


# ---- layouts -------------------------------------------------------------------------------------------------------


def lines_of(command, *arguments):
    ended = command("results", *map(str, arguments))
    assert (ended.code, ended.err) == (0, "")
    return ended.out.splitlines()


def test_a_problem_that_stands_in_two_columns_is_printed_twice(command, cwd):
    lines = lines_of(command, table1(cwd / "done"))
    (row,) = [line.split() for line in lines if line.startswith("LLM3 Scratch ") and len(line.split()) == 20]
    assert row[8:11] == row[11:14]


def test_the_papers_figures_stand_below_ours_in_our_places(command, cwd):
    lines = lines_of(command, table1(cwd / "done"))
    paper = [line for line in lines if line.startswith("- the paper")]
    assert len(paper) == 4
    assert paper[0].split()[3:12] == ["100", "1.6", "11.8", "100", "4.4", "28.4", "60", "11.4", "39.8"]
    ours = lines[lines.index(paper[0]) - 1]
    assert len(ours) == len(paper[0])
    assert f"the paper: {PAPER}" in lines


def test_figures_of_two_methods_of_one_row_are_followed_by_the_published_ones_once(command, cwd):
    published = read_experiment_folder(table2(cwd / "paper")).experiment.published
    made = experiment(("LLM (a)", "LLM (b)"), ("medium-small",), 3, published=published)
    lines = lines_of(command, write(cwd / "done", made, capped("LLM (a)", "medium-small", (3, 4, 5))))
    first = lines.index(next(line for line in lines if line.startswith("LLM (a)")))
    assert [line[:11] for line in lines[first : first + 3]] == ["LLM (a)    ", "LLM (b)    ", "- the paper"]


def test_two_sources_are_told_apart(command, cwd):
    one = read_experiment_folder(table2(cwd / "paper")).experiment.published[0]
    other = replace(one, source="Somebody else")
    made = experiment(("LLM",), ("medium-small",), 3, published=(one, other))
    lines = lines_of(command, write(cwd / "done", made, []))
    assert [line.partition("  ")[0] for line in lines if line.startswith("- ")] == [
        "- the paper (1)",
        "- the paper (2)",
    ]
    assert f"the paper (1): {PAPER}" in lines
    assert "the paper (2): Somebody else" in lines
    made = experiment(("LLM",), ("medium-small",), 3, published=(one, replace(other, label="another lab")))
    lines = lines_of(command, write(cwd / "labels", made, []))
    assert [line.partition("  ")[0] for line in lines if line.startswith("- ")] == ["- the paper", "- another lab"]


def test_a_place_that_is_not_complete_is_marked_and_an_empty_one_is_a_dash(command, cwd):
    made = experiment(("one", "other"), ("hard-small",), 10)
    folder = write(cwd / "done", made, capped("one", "hard-small", (3, 4, 5, 20, 1, 1, 2)))
    lines = lines_of(command, folder)
    assert "one     85.7*  5.1*  36.0*" in lines
    assert "other       -     -      -" in lines
    assert "* one, hard-small: 7/10 runs" in lines
    assert "3 runs of one on hard-small are missing." in lines
    assert "No run of 'other' has ended." in lines


def test_measures_of_a_layout_can_be_any(command, cwd):
    layout = Layout("Cost", ("tokens", "seconds"), (Group("All", (Column("Hard", "hard-small"),)),))
    folder = write(cwd / "done", experiment(("one",), seeds=1, layouts=(layout,)), [run(calls=4)])
    assert "one       4400      2.0" in lines_of(command, folder)
    assert "one       4400" in lines_of(command, folder, "--no-seconds")


def test_problems_without_a_run_are_told_in_one_line(command, cwd):
    made = experiment(("one", "other"), ("hard-small", "easy-small", "easy-large"), 2)
    folder = write(
        cwd / "done", made, [run(method, "hard-small", seed) for method in ("one", "other") for seed in (0, 1)]
    )
    lines = lines_of(command, folder)
    assert "No run on easy-small, easy-large has ended." in lines
    assert not [line for line in lines if line.startswith(("one", "other")) and "easy-" in line]
    assert not [line for line in lines_of(command, folder, str(folder)) if line.startswith("one") and "easy-" in line]
    assert not [line for line in lines if "missing" in line]


def test_seeds_with_a_gap_between_them_are_told(command, cwd):
    made = experiment(("one",), ("hard-small",), 10)
    lines = lines_of(command, write(cwd / "gap", made, [run("one", "hard-small", seed) for seed in (0, 1, 2, 7, 9)]))
    assert "The figures are of all seeds together: 0 to 2, 7, 9." in lines
    lines = lines_of(command, write(cwd / "whole", made, [run("one", "hard-small", seed) for seed in range(5)]))
    assert not [line for line in lines if line.startswith("The figures are of all seeds")]


# ---- what the reader must know -------------------------------------------------------------------------------------


def test_every_kind_of_remark(command, cwd):
    lines = lines_of(command, table1(cwd / "one"))
    assert lines[-4:] == [
        "1 run of LLM3 Backtrack on easy-small crashed, and no figure has it in it. The first one, seed 3: "
        "KeyError: 'red box'",
        "1 run of Backtrack on easy-small ended in an error, and no figure has it in it. The first one, seed 0: "
        "the server does not answer.",
        "1 run of Backtrack on medium-small is missing.",
        "2 runs of Scratch on hard-large are missing.",
    ]
    assert lines_of(command, table2(cwd / "two"))[-3:] == [
        "No run of 'LLM + Feedback' has ended.",
        "1 run of Random Samples on medium-small met a limit of wall-clock time inside of a query, and may end "
        "otherwise when run again.",
        "No language model answered in 'Random Samples'; #LM counts what stood in for one, if anything did.",
    ]


def test_several_crashes_are_one_line(command, cwd):
    runs = [run(seed=s, calls=0, status="crashed", error=f"KeyError: {s}") for s in (1, 2)]
    folder = write(cwd / "done", experiment(("one",), seeds=3), [run(), *runs])
    assert (
        "2 runs of one on hard-small crashed, and no figure has them in it. The first one, seed 1: KeyError: 1"
        in lines_of(command, folder)
    )


# ---- two folders ---------------------------------------------------------------------------------------------------


def test_two_folders_one_after_the_other_and_then_their_differences(command, cwd):
    made = experiment(("one",), seeds=6)
    first = write(Path("first"), made, capped("one", "hard-small", (3, 4, 5, 6, 7, 8)), {"llm3": "0.1.0", "numpy": "2"})
    later = write(Path("later"), made, capped("one", "hard-small", (4, 5, 6, 7, 8, 9)), {"llm3": "0.2.0", "numpy": "2"})
    lines = lines_of(command, first, later)
    heads = [line for line, below in pairwise(lines) if below.startswith("===")]
    assert heads == ["first: An experiment", "later: An experiment", "later minus first"]
    row = next(line for line in lines[lines.index("later minus first") :] if line.startswith("one "))
    assert row.split()[:4] == ["one", "one", "hard-small", "6"]
    assert "+1.0 [+1.0, +1.0]" in row
    assert lines[-1] == "Other versions: llm3 is 0.2.0 and was 0.1.0."


def test_what_has_nothing_in_common_is_not_compared(command, cwd):
    first = write(Path("first"), experiment(("one",)), [])
    other = experiment(("one",))
    changed = replace(other, problems=(replace(other.problems[0], setting="hard-large"),))
    later = write(Path("later"), changed, [])
    lines = lines_of(command, first, later)
    assert lines[-2:] == [
        "They have no method and problem in common.",
        "hard-small is not the same problem in both, and is not compared.",
    ]


# ---- formats -------------------------------------------------------------------------------------------------------


def test_csv_has_every_figure_in_one_form(command, cwd):
    first, later = table1(cwd / "first"), table1(cwd / "later")
    rows = list(csv.DictReader(io.StringIO(command("results", str(first), str(later), "--format", "csv").out)))
    assert {row["kind"] for row in rows} == {"count", "value", "difference", "published"}
    assert not any(None in row or None in row.values() for row in rows)
    summary = summarize([read_experiment_folder(first)])[0]
    ours = [r for r in rows if r["folder"] == str(first)]
    assert sum(r["kind"] == "value" for r in ours) == sum(len(c.estimates) for c in summary.cells)
    (found,) = [
        r
        for r in ours
        if (r["kind"], r["method"], r["problem"], r["measure"], r["over"])
        == ("value", "Scratch", "hard-large", "success", "all")
    ]
    assert (found["n"], found["mean"]) == ("8", "0.5")
    between = [r for r in rows if r["kind"] == "difference" and r["other_folder"] == str(first) != r["folder"]]
    assert between
    assert {r["mean"] for r in between} == {"0"}
    place = ("published", "Scratch", "easy-small", "success")
    (paper,) = [r for r in ours if (r["kind"], r["method"], r["problem"], r["measure"]) == place]
    assert (paper["mean"], paper["other"]) == ("1", PAPER)


@pytest.mark.parametrize("format_", ENDINGS)
def test_without_seconds_other_times_and_another_place_give_the_same_bytes(command, cwd, format_):
    made = experiment(("one", "other"), ("hard-small", "easy-small"), 5)
    runs = [run(m, p, s, 1 + s) for m in ("one", "other") for p in ("hard-small", "easy-small") for s in range(5)]
    here = write(cwd / "here", made, runs)
    there = write(cwd / "there", made, [replace(r, seconds=r.seconds**2) for r in reversed(runs)])
    one, two = (command("results", str(folder), "--format", format_, "--no-seconds") for folder in (here, there))
    assert one == two
    assert "seconds" not in one.out
    assert "seconds" in command("results", str(here), "--format", format_).out


@pytest.mark.parametrize("format_", ENDINGS)
def test_nothing_is_printed_as_nan_where_there_is_nothing(command, cwd, format_):
    folder = write(cwd / "done", experiment(seeds=1), [run(), run("other", calls=20, status="not solved")])
    empty = write(cwd / "empty", experiment(), [])
    for ended in (command("results", str(f), "--format", format_) for f in (folder, empty)):
        assert (ended.code, ended.err) == (0, "")
        assert "nan" not in ended.out.lower()
        assert "inf" not in ended.out.lower()


def test_names_cannot_break_a_table(command, cwd):
    name = 'a|b [31m <i> 机器人, "x"'
    folder = write(cwd / "done", experiment((name,), seeds=1), [run(name)])
    text = command("results", str(folder)).out
    assert "a|b" in text
    markdown = command("results", str(folder), "--format", "markdown").out
    assert r"| a\|b [31m \<i\> 机器人" in markdown
    rows = list(csv.DictReader(io.StringIO(command("results", str(folder), "--format", "csv").out)))
    assert {row["method"] for row in rows} == {'a|b [31m <i> 机器人, "x"'}


def test_columns_stand_below_their_heads(command, cwd):
    for line in lines_of(command, table1(cwd / "done")):
        if line.startswith("-" * 5):
            ruler = line
            break
    lines = lines_of(command, cwd / "done")
    start = lines.index(ruler)
    body = lines[start - 1 : start] + lines[start + 1 : lines.index("", start)]
    gaps = [i for i in range(len(ruler)) if ruler[i] == " "]
    assert all(line[i] == " " for line in body for i in gaps)
    assert {len(line) for line in body} == {len(ruler)}


# ---- errors and endings --------------------------------------------------------------------------------------------


def test_a_folder_that_is_not_there_or_of_something_else(command, cwd):
    ended = command("results nowhere")
    assert (ended.code, ended.out, ended.err) == (3, "", "llm3: error: nowhere: No such file or directory\n")
    Path("else").mkdir()
    ended = command("results else")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err == "llm3: error: 'else' holds no experiment.json: it is not the folder of an experiment.\n"


def test_a_damaged_line_is_named(command, cwd):
    folder = write(Path("done"), experiment(), [run(), run(seed=1)])
    runs = folder / "runs.jsonl"
    runs.write_text(runs.read_text().replace('"status":"solved"', '"status":"fine"', 1))
    ended = command("results done")
    assert (ended.code, ended.out) == (3, "")
    sentence = "Invalid enum value 'fine' - at `$.status`; valid: 'crashed', 'error', 'not solved', 'solved'"
    assert ended.err == f"llm3: error: done/runs.jsonl, line 2: {sentence}\n"


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("results", "the following arguments are required: DIR. See 'llm3 results --help'."),
        ("results done --format html", "unknown format 'html'. Known: csv, markdown, text."),
        ("results done --format mark", "unknown format 'mark'; did you mean 'markdown'? Known: csv, markdown, text."),
    ],
)
def test_usage_errors(command, line, said):
    ended = command(line)
    assert (ended.code, ended.out, ended.err) == (2, "", f"llm3: error: {said}\n")


def test_as_a_process_it_prints_the_tables_and_loads_no_matplotlib(cwd):
    table2(cwd / "done")
    ended = run_command([*llm3("results done")], cwd, environment())
    assert (ended.code, ended.err) == (0, "")
    assert ended.out == (SNAPSHOTS / "table2.txt").read_text(encoding="utf-8")
    code = (
        "import sys; from llm3.cli.main import main; main(['results', 'done']); sys.exit('matplotlib' in sys.modules)"
    )
    assert run_command([sys.executable, "-c", code], cwd, environment()).code == 0


def test_from_python_the_same(cwd):
    summaries = summarize([read_experiment_folder(table2(cwd / "done"))])
    (section,) = report(summaries)
    assert section.title == "Samplers"
    assert as_csv(summaries) == (SNAPSHOTS / "table2.csv").read_text(encoding="utf-8")
