"""`llm3 results --plot`: which figures there are, and what is said of those that are not."""

import sys
from dataclasses import replace
from pathlib import Path

import pytest
from experiment_folders import budgets, experiment, run, table1, table2, write

from llm3.experiments import Experiment, Method, ProblemFamily, RunKey, read_experiment_folder, record_folder
from llm3.results.figures.layouts import colors_of

PNG = b"\x89PNG\r\n\x1a\n"
ALWAYS = {"success-by-motion-calls.png", "success-by-seconds.png", "failures-by-kind.png"}
ALL = ALWAYS | {"success-by-llm-calls.png", "success-by-tokens.png"}
VIEWED = """
from llm3 import hookimpl
from llm3.types import Shape
from llm3_corridor import Corridor

class Viewed(Corridor):
    name = "viewed"
    def top_view(self, instance, options, state):
        x = state.configuration[0]
        robot = Shape("robot", ((x, 0), (x + 0.1, 0), (x, 0.1)))
        return Shape("corridor", ((0, 0), (5, 0), (5, 1), (0, 1)), fixed=True), robot

@hookimpl
def llm3_domains():
    return {"viewed": Viewed}
"""


def figures(folder: Path) -> set[str]:
    for path in folder.rglob("*.png"):
        assert path.read_bytes().startswith(PNG)
    return {str(path.relative_to(folder)) for path in folder.rglob("*")}


@pytest.fixture
def recorded(command, install, cwd):
    """Writes an experiment of a domain whose runs of seed 1 have records."""

    def make(domain: str) -> Path:
        install("llm3_viewed", VIEWED)
        methods = (Method("_one", "one", {}), Method("b_$", "b", {}))
        made = Experiment("made-up", "", (0, 1), (ProblemFamily("wide $x$", domain, "wide"),), methods)
        folder = write(cwd / "done", made, [run("_one", "wide $x$", 1)])
        where = folder / record_folder(RunKey("_one", "wide $x$", 1))
        where.parent.mkdir(parents=True)
        assert command("--domain", domain, "--seed", "1", "--quiet", "--out", str(where)).code == 0
        return folder

    return make


def test_every_figure_is_a_png_and_the_tables_are_printed_all_the_same(command, cwd):
    plain = command("results", str(table2(cwd / "done")))
    ended = command("results", "done", "--plot", "new/figures")
    assert (ended.code, ended.out) == (0, plain.out)
    assert figures(Path("new/figures")) == ALL
    assert ended.err.splitlines() == [
        "new/figures/success-by-llm-calls.png",
        "new/figures/success-by-motion-calls.png",
        "new/figures/success-by-tokens.png",
        "new/figures/success-by-seconds.png",
        "new/figures/failures-by-kind.png",
        "'done' holds no records of its runs: the layouts that they tried are not drawn.",
    ]


def test_the_same_results_give_the_same_bytes(command, cwd):
    table2(cwd / "done")
    for folder in ("one", "two"):
        assert command("results", "done", "--plot", folder, "--no-seconds").code == 0
    assert figures(Path("one")) == ALL - {"success-by-seconds.png"}
    for path in Path("one").iterdir():
        assert path.read_bytes() == (Path("two") / path.name).read_bytes()


def test_problems_without_runs_have_no_panels(command, cwd):
    for folder, problems in (("one", ("hard-small",)), ("three", ("easy-small", "hard-small", "hard-large"))):
        write(cwd / folder, experiment(problems=problems, seeds=1), [run(), run("other")])
        assert command("results", folder, "--plot", f"{folder}-drawn").code == 0
    assert figures(Path("three-drawn")) == ALL
    for name in ALL:
        assert (Path("three-drawn") / name).read_bytes() == (Path("one-drawn") / name).read_bytes()


def test_objects_have_the_colours_that_their_names_begin_with():
    found = colors_of(["carrot", "red_box", "tan_box", "white_box"])
    assert (found["red_box"], found["tan_box"]) == ("red", "tan")
    assert len(set(found.values())) == 4
    assert "white" not in found.values()


def test_earlier_figures_are_replaced(command, cwd):
    write(cwd / "done", experiment(seeds=1), [run()])
    Path("drawn").mkdir()
    for name in ALL:
        (Path("drawn") / name).write_text("old", encoding="utf-8")
    assert command("results", "done", "--plot", "drawn").code == 0
    assert figures(Path("drawn")) == ALL


@pytest.mark.slow
def test_many_panels(command, cwd):
    table1(cwd / "done")
    assert command("results", "done", "--plot", "drawn").code == 0
    assert figures(Path("drawn")) == ALL


def test_several_experiments_have_a_folder_each(command, cwd):
    write(cwd / "done", experiment(seeds=1), [run()])
    ended = command("results", "done", "done", "--plot", "drawn", "--no-seconds")
    assert ended.code == 0
    assert {path.name for path in Path("drawn").iterdir()} == {"1-done", "2-done"}


def test_an_experiment_without_runs_can_be_drawn(command, cwd):
    write(cwd / "done", experiment(), [])
    assert command("results", "done", "--plot", "drawn").code == 0
    assert figures(Path("drawn")) == ALWAYS


def test_what_no_method_spends_is_not_drawn(command, cwd):
    whole = budgets(cwd / "whole")
    assert command("results", "whole", "--plot", "drawn").code == 0
    assert figures(Path("drawn")) == ALL
    record = read_experiment_folder(whole)
    for methods, drawn in ((("rules", "search"), ALL - {"success-by-tokens.png"}), (("search",), ALWAYS)):
        made = replace(record.experiment, methods=tuple(m for m in record.experiment.methods if m.name in methods))
        name = "-".join(methods)
        write(cwd / name, made, [line for key, line in record.runs.items() if key.method in methods])
        ended = command("results", name, "--plot", f"{name}-drawn")
        assert ended.code == 0
        assert figures(Path(f"{name}-drawn")) == drawn
        said = f"no method of '{name}' spends tokens that are known: success-by-tokens.png is not drawn."
        assert said in ended.err.splitlines()
    assert ended.err.splitlines()[0] == (
        "no method of 'search' spends model calls that are known: success-by-llm-calls.png is not drawn."
    )


def test_the_layouts_of_the_first_seed_with_records_are_drawn(command, recorded):
    ended = command("results", str(recorded("viewed")), "--plot", "drawn")
    assert ended.code == 0
    assert figures(Path("drawn")) == ALL | {"layouts-of-seed-1.png"}
    assert ended.err.splitlines()[-1] == "drawn/layouts-of-seed-1.png"


def test_a_domain_without_a_view_from_above_is_named(command, recorded):
    ended = command("results", str(recorded("corridor")), "--plot", "drawn")
    assert ended.code == 0
    assert figures(Path("drawn")) == ALL
    said = "the layouts of _one / wide $x$ / 1 are not drawn: its domain has no top view."
    assert ended.err.splitlines()[-1] == said


def test_a_domain_that_answers_something_else_is_named(command, recorded, monkeypatch):
    folder = recorded("viewed")
    from llm3_viewed import Viewed

    monkeypatch.setattr(Viewed, "top_view", lambda *_: ("robot",))
    ended = command("results", str(folder), "--plot", "drawn")
    assert ended.code == 0
    said = "Viewed.top_view must answer a tuple of Shape, and 'robot' is none."
    assert ended.err.splitlines()[-1] == f"the layouts of _one / wide $x$ / 1 are not drawn: {said}"


def test_a_record_that_cannot_be_read_is_named(command, recorded):
    folder = recorded("viewed")
    (events,) = folder.rglob("events.jsonl")
    events.unlink()
    ended = command("results", str(folder), "--plot", "drawn")
    assert ended.code == 0
    assert figures(Path("drawn")) == ALL
    said = f"the layouts of _one / wide $x$ / 1 are not drawn: {events}: No such file or directory"
    assert ended.err.splitlines()[-1] == said


def test_a_folder_that_cannot_be_written_is_named(command, cwd):
    write(cwd / "done", experiment(seeds=1), [run()])
    Path("file").write_text("", encoding="utf-8")
    ended = command("results", "done", "--plot", "file")
    assert ended.code == 3
    said = "llm3: error: the figure 'file/success-by-llm-calls.png' cannot be written: File exists.\n"
    assert ended.err == said


def test_without_matplotlib_it_says_so_before_anything_is_printed(command, cwd, monkeypatch):
    write(cwd / "done", experiment(seeds=1), [run()])
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    ended = command("results", "done", "--plot", "drawn")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err == "llm3: error: figures need matplotlib, which is not installed: pip install 'llm3[plot]'.\n"
    assert not Path("drawn").exists()
