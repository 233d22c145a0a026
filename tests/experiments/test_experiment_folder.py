"""What an experiment leaves in its folder, and when it may go on there."""

import json
from pathlib import Path

import pytest
from experiment_files import CORRIDOR, carry_out, experiment, lines_of, without_times
from hypothesis import example, given, settings
from hypothesis import strategies as st

from llm3.errors import InputError, LLM3Error, OutputExists
from llm3.experiments import ExperimentWriter, RunKey, RunLine, read_experiment_folder, record_folder
from llm3.records.json_lines import LineWriter

RANDOM = {"llm": "random", "strategy": "sample-params", "feedback": "none"}
pytestmark = pytest.mark.usefixtures("plugins")
HERE = Path("out")


@pytest.fixture(autouse=True)
def in_an_empty_folder(cwd):
    pass


def test_each_run_is_a_line_and_can_be_read_back():
    lines = carry_out(HERE, experiment())
    found = read_experiment_folder(HERE)
    assert found.experiment == experiment()
    assert found.missing == 0
    assert list(found.runs.values()) == lines
    assert [line["key"] for line in lines_of(HERE)] == [
        {"method": method, "problem": "default", "seed": seed}
        for seed in range(3)
        for method in ("random", "one random try")
    ]


def test_what_a_line_says_is_what_the_run_did():
    lines = {line.key.method: line for line in carry_out(HERE, experiment(attempts=1), records=True)}
    many, one = lines["random"], lines["one random try"]
    assert (many.status, many.stop, many.plan_length) == ("solved", "solved", 2)
    assert many.iterations == many.stats.llm_calls <= 30
    assert sum(many.failures.values()) < many.iterations
    assert (one.status, one.stop, one.iterations) == ("not solved", "calls", 1)
    assert one.failures == {"goal in collision": 1} or one.unmet


def test_an_experiment_that_is_there_is_not_run_again():
    carry_out(HERE, experiment())
    before = (HERE / "runs.jsonl").read_bytes()
    assert carry_out(HERE, experiment()) == []
    assert (HERE / "runs.jsonl").read_bytes() == before


@given(st.data())
@settings(max_examples=30)
def test_only_what_is_missing_is_run_wherever_the_file_was_cut_off(tmp_path_factory, data):
    asked = experiment(attempts=1)
    folder = tmp_path_factory.mktemp("cut") / "out"
    carry_out(folder, asked)
    whole = (folder / "runs.jsonl").read_bytes()
    expected = without_times(lines_of(folder))
    cut = int(data.draw(st.floats(0, 1)) * len(whole))  # its length differs by the digits of times
    (folder / "runs.jsonl").write_bytes(whole[:cut])
    kept = read_experiment_folder(folder).runs
    assert len(kept) == max(whole[: cut + 1].count(b"\n") - 1, 0)
    assert len(carry_out(folder, asked)) == len(asked) - len(kept)
    assert without_times(lines_of(folder)) == expected


def test_runs_have_records_where_they_are_wanted():
    carry_out(HERE, experiment(attempts=1), records=True)
    for key in read_experiment_folder(HERE).runs:
        folder = HERE / record_folder(key)
        assert json.loads((folder / "run.json").read_text())["config"]["seed"] == key.seed
    carry_out(Path("bare"), experiment())
    assert not (Path("bare") / "records").exists()


@given(st.lists(st.text(min_size=1, max_size=80), min_size=1, max_size=6, unique=True))
@example(["LLM", "LLM+", "llm"])
@example(["\u65b9\u6cd5\u4e00", "\u65b9\u6cd5\u4e8c"])
@example(["..", ".", "a/../b"])
def test_no_two_methods_share_a_folder_and_every_file_system_takes_its_name(names):
    folders = [record_folder(RunKey(name, "default", 0)) for name in names]
    assert len({str(folder).lower() for folder in folders}) == len(names)
    for folder in folders:
        assert folder.parts[0] == "records"
        assert len(folder.parts) == 4
        assert set(folder.parts[1]) <= set("abcdefghijklmnopqrstuvwxyz0123456789.-~")
        assert not folder.parts[1].startswith(".")
        assert len(folder.parts[1]) < 100


class TestGoingOn:
    """In a folder that is not empty."""

    @pytest.mark.parametrize(
        ("changes", "said"),
        [
            ({"name": "runs"}, "its name is 'walks', not 'runs'"),
            (
                {"methods": [{"name": "random", **RANDOM}, {"name": "one random try", **RANDOM}]},
                "of its method 'random' max_llm_calls is left out and was 30",
            ),
            (
                {"problems": [{"domain": "corridor", "setting": "default", "options": {"a": "b"}}]},
                "of its problem 'default' a is b and was left out",
            ),
        ],
    )
    def test_another_experiment_is_refused_and_nothing_is_touched(self, changes, said):
        carry_out(HERE, experiment())
        before = {f.name: f.read_bytes() for f in HERE.iterdir() if f.is_file()}
        with pytest.raises(OutputExists) as caught:
            carry_out(HERE, experiment(**changes))
        assert str(caught.value) == f"'out' holds another experiment: {said}. Choose another folder."
        assert {f.name: f.read_bytes() for f in HERE.iterdir() if f.is_file()} == before

    def test_a_problem_of_another_name_is_refused_as_it_would_count_twice(self):
        carry_out(HERE, experiment())
        named = {**CORRIDOR["problems"][0], "name": "corridor/default"}
        with pytest.raises(OutputExists) as caught:
            carry_out(HERE, experiment(problems=[named]))
        assert str(caught.value) == (
            "'out' holds another experiment: its problem 'default' is called 'corridor/default' now. "
            "Choose another folder."
        )

    def test_more_seeds_methods_and_problems_are_the_same_experiment(self):
        carry_out(HERE, experiment(attempts=2))
        more = {"attempts": 4, "methods": [*CORRIDOR["methods"], {"name": "search", "solver": "search"}]}
        assert len(carry_out(HERE, experiment(**more))) == 2 * 2 + 4
        found = read_experiment_folder(HERE)
        assert (found.experiment, found.missing) == (experiment(**more), 0)

    def test_what_is_no_longer_asked_but_has_runs_stays(self):
        carry_out(HERE, experiment(attempts=3))
        less = experiment(attempts=1, methods=[CORRIDOR["methods"][1]])
        assert carry_out(HERE, less) == []
        found = read_experiment_folder(HERE)
        assert [method.name for method in found.experiment.methods] == ["one random try", "random"]
        assert (found.experiment.seeds, len(found.runs), found.missing) == ((0, 1, 2), 6, 0)

    def test_a_part_of_it_can_be_run_first_and_what_has_no_runs_may_still_change(self):
        carry_out(HERE, experiment(), part=experiment().only(methods=("random",)))
        assert read_experiment_folder(HERE).missing == 3
        other = [CORRIDOR["methods"][0], {**CORRIDOR["methods"][1], "max_llm_calls": 2}]
        assert len(carry_out(HERE, experiment(methods=other))) == 3

    def test_another_version_is_refused_unless_it_may_be_mixed_and_then_it_is_remembered(self):
        carry_out(HERE, experiment())
        with pytest.raises(OutputExists) as caught, ExperimentWriter(HERE, experiment(), {"llm3": "2", "numpy": "3"}):
            pass
        assert str(caught.value) == (
            "'out' was made with llm3 1, and here is 2: choose another folder, or give --mix-versions to go on with "
            "both."
        )
        with ExperimentWriter(HERE, experiment(), {"llm3": "2", "numpy": "3"}, mix_versions=True):
            pass
        found = read_experiment_folder(HERE)
        assert found.versions == {"llm3": "2", "numpy": "3"}
        assert found.earlier == ({"llm3": "1"},)
        carry = ExperimentWriter(HERE, experiment(), {"llm3": "2"})
        with carry:
            pass
        assert read_experiment_folder(HERE).earlier == ({"llm3": "1"},)

    def test_what_a_killed_program_left_before_it_began_is_no_hindrance(self):
        HERE.mkdir()
        (HERE / "lock").touch()
        (HERE / "experiment.json.17.new").touch()
        assert len(carry_out(HERE, experiment())) == 6

    def test_how_the_tables_look_may_change(self):
        carry_out(HERE, experiment())
        asked = experiment(title="Another title", budgets={"llm_calls": [1, 5]})
        assert carry_out(HERE, asked) == []
        assert read_experiment_folder(HERE).experiment == asked

    def test_a_folder_with_other_things_in_it_is_refused(self):
        HERE.mkdir()
        (HERE / "thesis.tex").touch()
        with pytest.raises(OutputExists) as caught:
            carry_out(HERE, experiment())
        assert str(caught.value) == "the output folder 'out' is not empty and holds no experiment: choose another."
        assert [f.name for f in HERE.iterdir()] == ["thesis.tex"]

    def test_a_file_is_no_folder(self):
        HERE.touch()
        with pytest.raises(OutputExists) as caught:
            carry_out(HERE, experiment())
        assert str(caught.value) == "'out' is a file, not a folder: choose another."

    def test_two_programs_never_write_one_folder(self):
        with ExperimentWriter(HERE, experiment(), {}):
            with pytest.raises(LLM3Error) as caught, ExperimentWriter(HERE, experiment(), {}):
                pass
            assert str(caught.value) == "another program is writing 'out': wait for it, or choose another folder."


class TestReading:
    """Folders that are not as they should be."""

    def test_what_is_no_experiment_is_told(self):
        with pytest.raises(InputError) as caught:
            read_experiment_folder(Path("nowhere"))
        assert str(caught.value) == "nowhere: No such file or directory"
        HERE.mkdir()
        with pytest.raises(InputError) as caught:
            read_experiment_folder(HERE)
        assert str(caught.value) == "'out' holds no experiment.json: it is not the folder of an experiment."

    def test_another_format_is_told(self):
        carry_out(HERE, experiment(attempts=1))
        file = HERE / "experiment.json"
        file.write_text(file.read_text().replace("llm3-experiment/1", "llm3-experiment/9"))
        with pytest.raises(InputError) as caught:
            read_experiment_folder(HERE)
        assert str(caught.value) == (
            "out/experiment.json: the format is 'llm3-experiment/9', and this version reads 'llm3-experiment/1'"
        )

    def test_a_spoilt_line_is_told_with_its_number(self):
        carry_out(HERE, experiment(attempts=1))
        file = HERE / "runs.jsonl"
        header, first, second = file.read_text().splitlines(keepends=True)
        file.write_text(header + first.replace('"solved"', '"sovled"') + second)
        with pytest.raises(InputError) as caught:
            read_experiment_folder(HERE)
        valid = "'crashed', 'error', 'not solved', 'solved'"
        assert (
            str(caught.value) == f"out/runs.jsonl, line 2: Invalid enum value 'sovled' - at `$.status`; valid: {valid}"
        )

    def test_counts_below_nothing_are_refused(self):
        carry_out(HERE, experiment(attempts=1))
        file = HERE / "runs.jsonl"
        file.write_text(file.read_text().replace('"motion_calls":', '"motion_calls":-', 1))
        with pytest.raises(InputError) as caught:
            read_experiment_folder(HERE)
        assert "and less than nothing cannot be" in str(caught.value)

    def test_lines_of_runs_that_the_experiment_does_not_have_are_counted(self):
        carry_out(HERE, experiment(attempts=1))
        file = HERE / "runs.jsonl"
        file.write_text(file.read_text().replace('"seed":0', '"seed":7', 1))
        found = read_experiment_folder(HERE)
        assert (found.strangers, found.missing) == (1, 1)


def test_a_full_disk_is_told_as_such(monkeypatch):
    asked = experiment(attempts=1)
    with ExperimentWriter(HERE, asked, {}) as writer:

        def write(_):
            raise OSError(28, "No space left on device")

        monkeypatch.setattr(LineWriter, "write", lambda self, value: write(value))
        with pytest.raises(LLM3Error) as caught:
            writer.add(RunLine(RunKey("random", "default", 0), "solved"))
        assert str(caught.value) == "the output folder 'out' cannot be written: No space left on device."
        assert not writer.ended


def test_a_line_of_a_run_that_is_done_again_replaces_the_first():
    asked = experiment(attempts=1)
    with ExperimentWriter(HERE, asked, {"llm3": "1"}) as writer:
        writer.add(RunLine(RunKey("random", "default", 0), "error", error="no server"))
    assert [line.key.method for line in carry_out(HERE, asked)] == ["one random try"]
    assert [line.key.method for line in carry_out(HERE, asked, retry=True)] == ["random"]
    assert {line.status for line in read_experiment_folder(HERE).runs.values()} == {"solved", "not solved"}
    assert carry_out(HERE, asked, retry=True) == []
