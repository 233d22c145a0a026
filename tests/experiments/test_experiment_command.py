"""`llm3 experiment` on the command line."""

from pathlib import Path

import pytest
from experiment_files import TOML, lines_of, without_times

from llm3.experiments import read_experiment_folder
from llm3.registry import Registry


@pytest.fixture(autouse=True)
def walks(cwd):
    """The experiment, in the working folder."""
    Path("walks.toml").write_text(TOML)


def test_an_experiment_leaves_its_runs_and_prints_its_tables(command):
    ended = command("experiment walks.toml --quiet")
    assert (ended.code, ended.err) == (0, "")
    folder = Path("experiments/walks")
    found = read_experiment_folder(folder)
    assert found.missing == 0
    assert found.versions["domain/corridor"] == "corridor (llm3_corridor 1.0)"
    assert found.versions["planner/birrt"].startswith("birrt (llm3 ")
    assert "platform" not in found.versions
    assert ended.out == command(f"results {folder}").out
    assert sorted(p.parent.name for p in folder.glob("records/random/default/*/run.json")) == ["0", "1", "2"]


def test_what_is_done_is_not_done_again(command):
    command("experiment walks.toml --out out --quiet --attempts 1")
    before = Path("out/runs.jsonl").read_bytes()
    again = command("experiment walks.toml --out out --attempts 1")
    assert "2 of 2 runs ended before in out" in again.err
    assert Path("out/runs.jsonl").read_bytes() == before
    assert command("experiment walks.toml --out out --attempts 2 --quiet").code == 0
    assert len(lines_of(Path("out"))) == 4
    command("experiment walks.toml --out out --attempts 3 --quiet --method random")
    assert len(lines_of(Path("out"))) == 5


def test_two_workers_do_what_one_does(command):
    command("experiment walks.toml --out one --quiet --no-records")
    command("experiment walks.toml --out two --quiet --no-records --workers 2")
    assert without_times(lines_of(Path("one"))) == without_times(lines_of(Path("two")))
    one, two = (command("results", name, "--no-seconds") for name in ("one", "two"))
    assert one.out == two.out
    assert not list(Path().glob("*/records"))


def test_progress_is_told_in_lines_and_ends_with_the_whole(command):
    ended = command("experiment walks.toml --out out --attempts 2 --method random")
    assert ended.err.splitlines()[0] == "No language model is used: the parameters are drawn at random."
    assert ended.err.splitlines()[-1].startswith("2 of 2 runs: 2 solved of 2, ")
    assert ended.err.splitlines()[-1].endswith(", 0 s left")


def test_the_stand_ins_of_all_domains_are_told(command):
    problems = """
[[problems]]
domain = "corridor"
setting = "default"

[[problems]]
domain = "tabletop2d"
setting = "clutter"

[[methods]]
name = "rules"
"""
    Path("two.toml").write_text('name = "two"\nattempts = 1\n' + problems)
    assert command("experiment two.toml").err.splitlines()[:2] == [
        "No language model is used: domain 'corridor' has no rule-based stand-in, so the backend 'random' draws the "
        "parameters.",
        "No language model is used: the rule-based stand-in of domain 'tabletop2d' writes the replies.",
    ]


def test_a_dry_run_says_what_would_be_done_and_does_nothing(command):
    ended = command("experiment walks.toml --dry-run")
    assert (ended.code, ended.err) == (0, "")
    assert ended.out == (
        "walks: 6 runs, of 2 methods on 1 problem with 3 seeds\n"
        "  random              3 runs, at most 90 proposals of random, which is no language model\n"
        "  one random try      3 runs, at most 3 proposals of random, which is no language model\n"
        "at most 0 calls of a language model\n"
    )
    assert [p.name for p in Path().iterdir()] == ["walks.toml"]


def test_a_dry_run_counts_the_calls_of_models_and_leaves_out_what_is_done(command, monkeypatch):
    monkeypatch.setenv("LLM3_API_KEY", "x")
    monkeypatch.setenv("LLM3_BASE_URL", "http://127.0.0.1:9/v1")
    Path("walks.toml").write_text(TOML + '\n[[methods]]\nname = "model"\nmodel = ["a", "b"]\nmax_llm_calls = 400\n')
    command("experiment walks.toml --out out --quiet --method random")
    ended = command("experiment walks.toml --out out --dry-run")
    assert ended.out == (
        "walks: 12 runs, of 4 methods on 1 problem with 3 seeds\n"
        "3 runs ended before in out, and 9 are missing\n"
        "  one random try      3 runs, at most 3 proposals of random, which is no language model\n"
        "  model (a)           3 runs, at most 1,200 calls of a\n"
        "  model (b)           3 runs, at most 1,200 calls of b\n"
        "at most 2,400 calls of a language model\n"
    )


@pytest.mark.parametrize("dry", ["", " --dry-run"])
def test_a_dry_run_refuses_what_the_run_would_refuse(command, dry):
    command("experiment walks.toml --out out --quiet --attempts 1")
    ended = command(f"experiment walks.toml --out out --set methods.random.max_llm_calls=7{dry}")
    assert (ended.code, ended.err) == (
        2,
        "llm3: error: 'out' holds another experiment: of its method 'random' max_llm_calls is 7 and was 30. Choose "
        "another folder.\n",
    )
    Path("mine").mkdir()
    Path("mine/thesis.tex").touch()
    ended = command(f"experiment walks.toml --out mine{dry}")
    assert (ended.code, ended.err) == (
        2,
        "llm3: error: the output folder 'mine' is not empty and holds no experiment: choose another.\n",
    )


def test_a_run_that_failed_is_told_and_done_again_when_asked(command):
    Path("replies.json").write_text("[]")
    Path("walks.toml").write_text(TOML + '\n[[methods]]\nname = "scripted"\nllm = "scripted:replies.json"\n')
    line = "experiment walks.toml --out out --attempts 1"
    ended = command(line)
    assert ended.code == 1
    assert "scripted / default / 0: error: the script has run out after 0 replies." in ended.err
    again = "1 of them ended with an error or a crash; with --retry they are done again"
    assert ended.err.splitlines()[-1] == again
    once_more = command(line)
    assert (once_more.code, once_more.err.splitlines()[-1]) == (1, again)
    assert len(lines_of(Path("out"))) == 3
    assert command(f"{line} --quiet --retry").code == 1
    assert len(lines_of(Path("out"))) == 4


def test_a_file_that_a_backend_reads_is_part_of_what_was_asked(command):
    Path("replies.json").write_text("[]")
    Path("walks.toml").write_text(TOML + '\n[[methods]]\nname = "scripted"\nllm = "scripted:replies.json"\n')
    command("experiment walks.toml --out out --attempts 1 --quiet")
    Path("replies.json").write_text('["x"]')
    changed = command("experiment walks.toml --out out --attempts 1 --quiet")
    assert changed.code == 2
    assert changed.err.startswith("llm3: error: 'out' was made with file replies.json ")


def test_a_part_is_run_and_the_tables_are_those_of_the_whole(command):
    ended = command("experiment walks.toml --out out --quiet --method random")
    rows = [line.split("  ")[0] for line in ended.out.partition("Every method")[0].splitlines()]
    assert ["random" in rows, "one random try" in rows] == [True, True]
    assert "No run of 'one random try' has ended." in ended.out
    assert command("experiment walks.toml --out out --quiet").code == 0
    assert len(lines_of(Path("out"))) == 6


def test_everything_in_the_file_can_be_set_on_the_command_line(command):
    command(
        "experiment",
        "walks.toml",
        "--quiet",
        "--no-records",
        "--out=out",
        "--attempts=2",
        "--seed=5",
        "--method=random",
        "--set",
        "methods.random.max_llm_calls=2",
        "--set=title=Other walks",
    )
    found = read_experiment_folder(Path("out")).experiment
    assert (found.title, found.seeds) == ("Other walks", (5, 6))
    assert {line["key"]["method"] for line in lines_of(Path("out"))} == {"random"}
    assert found.methods[0].settings["max_llm_calls"] == 2


WRONG = {
    "nowhere": f"unknown experiment 'nowhere'. Known: {', '.join(Registry.discover().names('experiment'))}.",
    "nowhere.toml": "nowhere.toml: No such file or directory",
    "walks.toml --model gpt": "every method of 'walks' has a backend of its own: leave out --model.",
    "walks.toml --llm offline": "every method of 'walks' has a backend of its own: leave out --llm.",
    "walks.toml --method radnom": "unknown method 'radnom' of experiment 'walks'; did you mean 'random'? Known: one "
    "random try, random.",
    "walks.toml --problem x": "unknown problem 'x' of experiment 'walks'. Known: default.",
    "walks.toml --at-once openai=3": "unknown provider 'openai' of experiment 'walks'. Known: random.",
    "walks.toml --at-once 3": "argument --at-once: expected PROVIDER=N, not '3'. See 'llm3 experiment --help'.",
    "walks.toml --at-once random=0": "argument --at-once: expected a whole number from 1 to 1000, not '0'. See 'llm3 "
    "experiment --help'.",
    "walks.toml --workers none": "argument --workers: expected a whole number from 1 to 1000, not 'none'. See 'llm3 "
    "experiment --help'.",
    "walks.toml --workers 2 --dask tcp://x:1": "--workers and --dask both say where runs are done: give one of them.",
    "walks.toml --set x": "argument --set: expected FIELD=VALUE, not 'x'. See 'llm3 experiment --help'.",
    "walks.toml --set planner=rrt": "walks.toml: unknown field `planner`, expected name, problems, methods, title, "
    "attempts, first_seed, run, layouts, published, budgets - at `$`",
    "walks.toml --attempts ten": 'walks.toml: Expected `int`, got `str` "ten" - at `$.attempts`',
    "walks.toml --set run.planner=rrt": "unknown planner 'rrt'; did you mean 'birrt'? Known: birrt, ompl-bitstar, "
    "ompl-lbkpiece, ompl-rrtconnect.",
}


@pytest.mark.parametrize(("line", "sentence"), WRONG.items(), ids=WRONG)
def test_what_cannot_be_is_told_in_a_line_before_anything_is_done(command, line, sentence):
    ended = command(f"experiment {line}")
    assert (ended.out, ended.err) == ("", f"llm3: error: {sentence}\n")
    assert ended.code in (2, 3)
    assert [p.name for p in Path().iterdir()] == ["walks.toml"]


def test_a_file_that_is_no_text_is_told(command):
    Path("walks.toml").write_bytes(b"name = '\xff'")
    ended = command("experiment walks.toml")
    assert ended.err == "llm3: error: walks.toml: not UTF-8 text: invalid start byte at byte 8\n"
