"""A recorded run, repeated without its model: the same plan to the byte, or a line that says where it parted."""

from __future__ import annotations

import json

import pytest
from corridor_replies import SCRIPT, reply

from llm3.records import read_events, read_run

CASSETTE = "--domain corridor --seed 7 --llm replay:tape.jsonl --out again"


def without_times(folder):
    """The events, but for what a clock shows."""

    def clean(value):
        if isinstance(value, dict):
            return {key: clean(item) for key, item in value.items() if key not in ("time", "seconds")}
        return [clean(item) for item in value] if isinstance(value, list) else value

    lines = (folder / "events.jsonl").read_text(encoding="utf-8").splitlines()
    return [clean(json.loads(line)) for line in lines]


@pytest.mark.parametrize("flags", ["--llm replay:first --out again", CASSETTE], ids=["folder", "cassette"])
def test_a_repeated_run_is_the_same_to_the_byte_and_says_so(command, recorded, cwd, flags):
    (cwd / "replies.json").unlink()
    ended = command(flags)
    assert (ended.code, ended.out) == (0, recorded.out)
    assert (cwd / "again/plan.json").read_bytes() == (cwd / "first/plan.json").read_bytes()
    assert without_times(cwd / "again") == without_times(cwd / "first")
    where = "first" if "first" in flags else "tape.jsonl"
    first, *_, last = ended.err.splitlines()
    assert first == f"No language model is used: the replies are replayed from '{where}', recorded without one."
    assert last == "the run repeated its recording: 4 prompts."
    assert not read_run(cwd / "again").language_model


def test_quiet_is_quiet(command, recorded):
    assert command("--llm replay:first --out again --quiet").err == ""


def test_a_repetition_can_be_repeated_and_recorded(command, recorded, cwd):
    command("--llm replay:first --out again --record second.jsonl")
    command("--llm replay:again --out third")
    assert (cwd / "third/plan.json").read_bytes() == (cwd / "first/plan.json").read_bytes()

    def exchanges(name):
        lines = (cwd / name).read_text(encoding="utf-8").splitlines()
        return [{k: v for k, v in json.loads(line).items() if k != "seconds"} for line in lines]

    assert exchanges("second.jsonl") == exchanges("tape.jsonl")


@pytest.mark.parametrize(
    ("flags", "sentence"),
    [
        ("--llm replay:first --out ./first --force", "'first' is what is replayed: give another --out."),
        (
            "--domain corridor --seed 3 --llm replay:first.jsonl --record first.jsonl --force --out again",
            "'first.jsonl' is what is replayed: give another --record.",
        ),
    ],
)
def test_a_recording_is_not_overwritten_by_its_own_replay(command, recorded, cwd, flags, sentence):
    """A replay that parts from its recording would leave nothing of it."""
    kept = {path: path.read_bytes() for path in (cwd / "first").iterdir()}
    ended = command(flags)
    assert (ended.code, ended.err) == (2, f"llm3: error: {sentence}\n")
    assert {path: path.read_bytes() for path in (cwd / "first").iterdir()} == kept


def test_the_configuration_comes_from_the_record(command, cwd):
    command(
        "--domain corridor --seed 3 --strategy sample-params --feedback binary --llm random --planner-iterations 99 "
        "--timing none --max-llm-calls 3 --trace-size 2 --max-reply-tokens 500 --max-tokens-total 10000 "
        "--max-seconds 60 --out first --quiet"
    )
    command("--llm replay:first --out again --quiet")
    first, again = (read_run(cwd / name).config for name in ("first", "again"))
    changed = {name for name in first.__dataclass_fields__ if getattr(first, name) != getattr(again, name)}
    assert changed == {"llm", "max_seconds"}  # no time passes with a model


def test_a_run_of_an_instance_file_is_repeated_without_the_file(command, cwd):
    command("instance --domain corridor --seed 7 --out mine.json")
    command("--domain corridor --instance mine.json --llm scripted:replies.json --out first --quiet")
    (cwd / "mine.json").unlink()
    ended = command("--llm replay:first --out again")
    assert ended.err.splitlines()[-1] == "the run repeated its recording: 4 prompts."
    assert (cwd / "again/plan.json").read_bytes() == (cwd / "first/plan.json").read_bytes()


@pytest.mark.parametrize(
    ("flags", "sentence"),
    [
        ("--seed 0", "the recording 'first' has --seed 7: leave out --seed 0"),
        ("--model gpt", "the recording 'first' has no --model: leave out --model gpt"),
        ("--max-llm-calls 5", "the recording 'first' has --max-llm-calls 20: leave out --max-llm-calls 5"),
        ("-D colour=red", "the recording 'first' has no -D colour: leave out -D colour=red"),
        ("--instance mine.json", "the recording 'first' has no --instance: leave out --instance mine.json"),
    ],
)
def test_a_flag_that_contradicts_the_record_is_refused(command, recorded, cwd, flags, sentence):
    ended = command(f"--llm replay:first --out again {flags}")
    assert (ended.code, ended.out) == (2, "")
    assert ended.err == f"llm3: error: {sentence}, or give --domain to replay it in another run.\n"
    assert not (cwd / "again").exists()


def test_a_flag_that_says_the_same_is_no_contradiction(command, recorded):
    ended = command("--llm replay:first --seed 7 --setting default --planner birrt --out again")
    assert ended.code == 0


def test_a_prompt_that_differs_ends_the_run_and_is_named(command, recorded, cwd):
    ended = command("--domain corridor --seed 8 --llm replay:first --out again")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err.splitlines()[-1] == (
        "llm3: error: the run parted from its recording 'first' at prompt 1: line 12 of the user message is "
        "'- wall: x range (0.9, 1.1); gap (0.48, 0.68)' there and '- wall: x range (0.9, 1.1); gap (0.3, 0.5)' here."
    )
    assert read_run(cwd / "again").status == "error"


def test_a_later_prompt_that_differs_is_named_with_its_number(command, recorded):
    ended = command("--domain corridor --seed 7 --feedback none --llm replay:first --out again")
    assert ended.code == 3
    assert ended.err.splitlines()[-1].startswith(
        "llm3: error: the run parted from its recording 'first' at prompt 2: line "
    )


def test_a_run_that_ends_before_its_recording_says_so(command, recorded):
    ended = command("--domain corridor --seed 7 --max-llm-calls 2 --llm replay:first --out again")
    assert ended.code == 1
    said = "the run parted from its recording: it ended after 2 prompts, and 'first' has 4."
    assert ended.err.splitlines()[-1] == said


@pytest.mark.parametrize(
    ("script", "status", "ending"),
    [(SCRIPT[:2], "error", "the call failed in the recording 'first', too: the script has run out after 2 replies."),
     (SCRIPT[:2], "running", "the recording 'first' ends after 2 prompts: its run was cut off."),
     (SCRIPT[:2], "interrupted", "the recording 'first' ends after 2 prompts: its run was interrupted."),
     ((), "running", "the recording 'first' ends after 0 prompts: its run was cut off.")],
)  # fmt: skip
def test_a_run_that_broke_off_is_repeated_that_far(command, cwd, script, status, ending):
    (cwd / "replies.json").write_text(json.dumps(script), encoding="utf-8")
    assert command("--domain corridor --llm scripted:replies.json --out first").code == 3
    if status != "error":
        path = cwd / "first/run.json"
        told = json.loads(path.read_text(encoding="utf-8"))
        path.write_text(json.dumps({**told, "status": status, "error": ""}), encoding="utf-8")
        events = cwd / "first/events.jsonl"
        *lines, failed = events.read_text(encoding="utf-8").splitlines(keepends=True)
        events.write_text("".join(lines) + failed[: len(failed) // 2], encoding="utf-8")
    ended = command("--llm replay:first --out again")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err.splitlines()[-1] == f"llm3: error: {ending}"
    assert len(list(read_events(cwd / "again"))) >= len(list(read_events(cwd / "first")))


def test_a_run_that_ran_out_of_time_is_repeated_to_its_end(command, cwd):
    (cwd / "replies.json").write_text(json.dumps([reply()] * 20_000), encoding="utf-8")
    assert command(
        "--domain corridor --llm scripted:replies.json --max-seconds 0.05 --max-llm-calls 100000 --out first"
    )
    assert read_run(cwd / "first").stop == "seconds"
    ended = command("--llm replay:first --out again")
    count = read_run(cwd / "first").stats.llm_calls
    assert (ended.code, ended.err.splitlines()[-1]) == (
        1,
        f"the run repeated its recording: {count} prompt{'s' * (count != 1)}.",
    )


def test_a_request_that_is_not_in_the_cassette_names_the_nearest(command, recorded):
    ended = command("--domain corridor --seed 8 --llm replay:tape.jsonl --out again")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err.splitlines()[-1] == (
        "llm3: error: prompt 1 of run 'corridor/default/8/backtrack/categorized' is not in the recording 'tape.jsonl'; "
        "the nearest is prompt 1 of run 'corridor/default/7/backtrack/categorized': line 12 of the user message is "
        "'- wall: x range (0.9, 1.1); gap (0.48, 0.68)' there and '- wall: x range (0.9, 1.1); gap (0.3, 0.5)' here."
    )


@pytest.mark.parametrize(
    ("flags", "code", "sentence"),
    [
        ("--llm replay", 2, "the backend 'replay' needs a cassette, or the folder of a run: "
         "--llm replay:cassette.jsonl."),
        ("--llm replay:nowhere", 3, "nowhere: No such file or directory"),
        ("--llm replay:replies.json", 3, "replies.json, line 1: Expected `object`, got `array`"),
        ("--llm replay:first/events.jsonl", 3, "first/events.jsonl, line 1: the format is 'llm3-events/1', "
         "and this version reads 'llm3-cassette/1'"),
        ("--llm replay:.", 3, "'.' holds no run.json: it is not the folder of a run."),
        ("--llm replay:tape.jsonl --model gpt", 2, "the recording 'tape.jsonl' was made with no model's flags, "
         "not with --model gpt: leave the latter out."),
    ],
)  # fmt: skip
def test_what_cannot_be_replayed_is_refused_before_the_run(command, recorded, cwd, flags, code, sentence):
    ended = command(f"--domain corridor --seed 7 {flags} --out again")
    assert (ended.code, ended.out, ended.err) == (code, "", f"llm3: error: {sentence}\n")
    assert not (cwd / "again").exists()


def test_without_a_domain_what_is_no_folder_is_named(command, recorded):
    assert command("--llm replay:nowhere").err == "llm3: error: nowhere: No such file or directory\n"
    assert command("--llm replay:.").err == "llm3: error: '.' holds no run.json: it is not the folder of a run.\n"
    assert command("--llm replay:tape.jsonl").err.startswith("llm3: error: no domain: give --domain NAME.")


# ---- --record ------------------------------------------------------------------------------------------------------


def test_the_cassette_of_another_run_is_left_alone_without_force(command, recorded, cwd):
    before = (cwd / "tape.jsonl").read_bytes()
    ended = command("--domain corridor --record tape.jsonl --out again")
    assert (ended.code, ended.out) == (2, "")
    assert ended.err == "llm3: error: the cassette 'tape.jsonl' exists: choose another file, or give --force.\n"
    assert (cwd / "tape.jsonl").read_bytes() == before
    assert not (cwd / "again").exists()
    assert command("--domain corridor --record tape.jsonl --out again --force").code == 0
    assert (cwd / "tape.jsonl").read_bytes() != before


def test_a_cassette_that_cannot_be_written_costs_no_record(command, recorded, cwd):
    before = (cwd / "first/events.jsonl").read_bytes()
    ended = command("--domain corridor --record replies.json/tape.jsonl --out first --force")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err == "llm3: error: the cassette 'replies.json/tape.jsonl' cannot be written: Not a directory.\n"
    ended = command("--domain corridor --record first --out first --force")
    assert (ended.code, ended.err) == (
        2,
        "llm3: error: 'first' is a folder, so no cassette can be written there.\n",
    )
    ended = command("--domain corridor --record first/events.jsonl --out first --force")
    assert (ended.code, ended.err) == (
        2,
        "llm3: error: 'first/events.jsonl' has the name of a file of the record: choose another for the cassette.\n",
    )
    assert (cwd / "first/events.jsonl").read_bytes() == before


def test_a_cassette_may_stand_beside_the_record_and_its_folder_is_made(command, cwd):
    assert command("--domain corridor --record here/tapes/tape.jsonl --out here --quiet").code == 0
    assert command("--domain corridor --llm replay:here/tapes/tape.jsonl --out again --quiet").code == 0


@pytest.mark.parametrize("keep", [0, 3], ids=["all of it", "most of it"])
def test_a_record_whose_events_were_lost_says_so(command, recorded, cwd, keep):
    path = cwd / "first/events.jsonl"
    path.write_bytes(b"".join(path.read_bytes().splitlines(keepends=True)[:keep]))
    ended = command("--llm replay:first --out again")
    assert ended.code == 3
    assert ended.err.splitlines()[-1] == (
        "llm3: error: the recording 'first' ends after 0 prompts: events.jsonl has lost the rest."
    )


# ---- a search, which has no conversation ---------------------------------------------------------------------------


@pytest.fixture
def search(command):
    """A recorded search, in the folder `found`."""
    return command("--domain corridor --seed 7 --solver search --out found --quiet")


def test_a_search_is_repeated_by_searching_again(command, search, cwd):
    ended = command("--llm replay:found --out again")
    assert (ended.code, ended.out) == (0, search.out)
    assert (cwd / "again/plan.json").read_bytes() == (cwd / "found/plan.json").read_bytes()
    assert without_times(cwd / "again") == without_times(cwd / "found")
    assert read_run(cwd / "again").config == read_run(cwd / "found").config


@pytest.mark.parametrize(
    ("flags", "code", "sentence"),
    [
        ("--llm replay:found --solver loop", 2,
         "the recording 'found' has --solver search: leave out --solver loop, or give --domain to replay it in "
         "another run."),
        ("--domain corridor --solver search --llm replay:found", 2,
         "the solver 'search' asks no model: leave out --llm."),
        ("--domain corridor --solver search --record tape.jsonl", 2,
         "a search asks no model, so --record would keep nothing: leave it out."),
        ("--domain corridor --llm replay:found", 3,
         "the recording 'found' ends after 0 prompts: its run was solved."),
    ],
)  # fmt: skip
def test_its_record_holds_no_conversation(command, search, cwd, flags, code, sentence):
    ended = command(f"{flags} --out again")
    assert (ended.code, ended.err.splitlines()[-1]) == (code, f"llm3: error: {sentence}")
    assert not (cwd / "tape.jsonl").exists()
