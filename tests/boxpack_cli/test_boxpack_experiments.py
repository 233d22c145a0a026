"""The paper's tables from the command line: by the stand-in, and by a model behind a server."""

from __future__ import annotations

import csv
import io
from pathlib import Path

import pytest
from command_line import environment, llm3, run

from llm3.errors import BackendError
from llm3.experiments import read_experiment_folder, record_folder
from llm3.records import read_exchanges
from llm3.testing import LLMServer
from llm3.types import Message, Request


def replies_of(folder: Path) -> dict[tuple[Message, ...], str]:
    """What was answered to each prompt of an experiment."""
    found = read_experiment_folder(folder)
    known: dict[tuple[Message, ...], str] = {}
    for key in found.runs:
        for exchange in read_exchanges(folder / record_folder(key)):
            assert exchange.reply
            known[exchange.request.messages] = exchange.reply.text
    return known


def layout_of(printed: str) -> list[list[str]]:
    """The figures of the first table's rows that are ours."""
    table, _, _ = printed.partition("Every method")
    names = ("LLM3 Backtrack", "Backtrack", "LLM3 Scratch", "Scratch")
    rows = [(name, line) for line in table.splitlines() for name in names if line.startswith(f"{name} ")]
    assert [name for name, _ in rows] == list(names)
    return [line.removeprefix(name).split() for name, line in rows]


@pytest.mark.slow
def test_table_1_by_the_stand_in_and_by_a_server_that_says_the_same(tmp_path):
    begun = "experiment table1 --attempts 2 --workers 2 --quiet"
    offline = run(llm3(f"{begun} --out offline"), tmp_path, environment())
    assert (offline.code, offline.err) == (0, "")
    known = replies_of(tmp_path / "offline")

    def script(request: Request) -> str:
        if request.messages not in known:
            raise BackendError("nobody asked this before")
        return known[request.messages]

    with LLMServer(script) as server:
        variables = environment(LLM3_BASE_URL=server.url, LLM3_API_KEY="none", NO_PROXY="127.0.0.1")
        served = run(llm3(f"{begun} --out served --model scripted"), tmp_path, variables)
        assert (served.code, served.err) == (0, "")
        runs = read_experiment_folder(tmp_path / "served").runs.values()
        assert len(server.requests) == sum(line.stats.llm_calls + line.stats.step_downs for line in runs)

    for line in runs:
        assert line.model
    for name in ("offline", "served"):
        found = read_experiment_folder(tmp_path / name)
        assert (len(found.runs), found.missing) == (40, 0)
        assert {line.status for line in found.runs.values()} <= {"solved", "not solved"}
        printed = run(llm3(f"results {name} --format csv --no-seconds"), tmp_path, environment()).out
        cells = [row for row in csv.DictReader(io.StringIO(printed)) if row["over"] == "all" and row["problem"]]
        assert len({(row["method"], row["problem"]) for row in cells}) >= 4 * 5
        assert all(row["mean"] for row in cells)
    tables = [run(llm3(f"results {name} --no-seconds"), tmp_path, environment()).out for name in ("offline", "served")]
    ours, theirs = map(layout_of, tables)
    assert ours == theirs
    for figures in ours:
        assert len(figures) == 3 * 6
        assert "-" not in figures
        assert figures[6:9] == figures[9:12]  # Setting 1 Hard and Setting 2 Small are one problem


@pytest.mark.slow
def test_the_smoke_experiment_runs_every_kind_of_method(tmp_path):
    ended = run(llm3("experiment smoke --out smoke"), tmp_path, environment())
    assert ended.code == 0
    runs = read_experiment_folder(tmp_path / "smoke").runs.values()
    assert len(runs) == 16
    assert {line.status for line in runs} <= {"solved", "not solved"}
    assert all(line.solved for line in runs if line.key.method.startswith("offline"))


def test_what_a_domain_cannot_make_is_told_before_anything_is_done(tmp_path):
    (tmp_path / "high.toml").write_text(
        'name = "high"\n[[problems]]\ndomain = "boxpack"\nsetting = "easy-small"\noptions = {walls = "9"}\n'
        '[[methods]]\nname = "rules"\nllm = "offline"\n',
        encoding="utf-8",
    )
    for more in ("", " --dry-run"):
        ended = run(llm3(f"experiment high.toml{more}"), tmp_path, environment())
        assert ended.err == "llm3: error: option 'walls' must be a height from 0 to 0.2 m or own, not '9'.\n"
        assert ended.code == 2
    assert [path.name for path in tmp_path.iterdir()] == ["high.toml"]


def test_one_row_of_table_2_has_its_published_figures_beside_it(tmp_path):
    words = ["--method=Random Samples", "--set=methods.Random Samples.max_llm_calls=2"]
    begun = llm3("experiment table2 --attempts 1 --quiet --no-records --out row")
    ended = run([*begun, *words], tmp_path, environment())
    assert (ended.code, ended.err) == (0, "")
    rows = ended.out.splitlines()
    first = next(number for number, row in enumerate(rows) if row.startswith("Random Samples"))
    ours, paper = rows[first : first + 2]
    assert paper.startswith("- the paper")
    assert ours.split()[-3:-2] == ["2.0"]
    assert paper.split()[-3:] == ["109.6", "663.1", "-"]
