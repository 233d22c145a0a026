"""What a run wrote reads back as what happened; a file that was cut off, as what had happened by then."""

import json
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from line_world import FINISH, Gamble, Line, LineInstance, TickingClock, go, line_registry, reply, take
from test_records import SOLVES, make_run, record

from llm3.assembly import RunConfig, Search, assemble
from llm3.errors import BackendError, InputError
from llm3.records import Recorder, read_events, read_exchanges, read_run
from llm3.types import CallFailed, Completion, PromptSent, ReplyReceived, RunEnded, RunStarted, Stats

actions = st.one_of(
    st.sampled_from([1.0, 2.0, 5.0, 8.0, FINISH]).map(go),
    st.sampled_from(
        ["take(['coin'], {})", "dance()", "go([], {'x': 99})", "go([], {'y': 'Ångström \\u2028 \\u0000'})"]
    ),
)
completions = st.builds(
    Completion,
    st.one_of(st.lists(actions, max_size=4).map(lambda plan: reply(*plan)), st.text(max_size=20)),
    st.builds(Stats, prompt_tokens=st.integers(0, 9), retries=st.integers(0, 3), seconds=st.just({"model": 0.1})),
    st.text(max_size=3),
    st.sampled_from(["", "stop", "length"]),
    st.text(max_size=5),
    st.lists(st.text(max_size=5), max_size=2).map(tuple),
)


def happened(folder, script, planner=None):
    """Solve with these replies, recorded; every event that an observer was told."""
    run = make_run(script)
    run = replace(run, planner=planner or run.planner)
    told = []
    try:
        with Recorder(folder, run, TickingClock()) as recorder:
            run.solve(lambda event: (recorder(event), told.append(event)))
    except BackendError:
        pass
    return told


def read(folder):
    return [recorded.event for recorded in read_events(folder)]


# ---- laws ----------------------------------------------------------------------------------------------------------


@given(st.lists(completions, max_size=3), st.booleans())
@settings(max_examples=60)
def test_what_is_written_reads_back_equal(script, gamble):
    with TemporaryDirectory() as name:
        told = happened(Path(name), script, Gamble() if gamble else None)
        assert read(Path(name)) == told


@given(seed=st.integers(0, 99), limit=st.integers(1, 12), found=st.booleans())
@settings(max_examples=30)
def test_what_is_written_of_a_search_reads_back_equal(seed, limit, found):
    regions = {("go", (), "x"): (FINISH, FINISH)} if found else {}
    config = RunConfig("full-line", seed=seed, solver="search", max_motion_calls=limit)
    told = []
    with TemporaryDirectory() as name, assemble(line_registry(), config, LineInstance(0.0)) as run:
        run = replace(run, solver=Search(regions), planner=Gamble())
        with Recorder(Path(name), run, TickingClock()) as recorder:
            run.solve(lambda event: (recorder(event), told.append(event)))
        assert read(Path(name)) == told
        assert list(read_exchanges(Path(name))) == []
        recorded = read_run(Path(name))
        assert (recorded.stop, recorded.plugins) == (told[-1].result.stop, run.plugins)


@pytest.fixture(scope="module")
def solved(tmp_path_factory):
    """The events of a solved run, and the bytes of their file."""
    folder = tmp_path_factory.mktemp("solved")
    return happened(folder, SOLVES), (folder / "events.jsonl").read_bytes()


@given(share=st.floats(0, 1))
@settings(max_examples=60)
def test_wherever_the_file_is_cut_off_what_happened_before_can_be_read(solved, share):
    told, whole = solved
    left = whole[: round(share * len(whole))]
    with TemporaryDirectory() as name:
        (Path(name) / "events.jsonl").write_bytes(left)
        complete = left.count(b"\n") + (whole[len(left) :][:1] == b"\n")  # a line is whole without its end, too
        assert read(Path(name)) == told[: max(0, complete - 1)]


def test_a_solved_run_and_one_whose_call_failed_read_back_equal(tmp_path):
    for name, script in (("solved", SOLVES), ("failed", [SOLVES[0], BackendError("gone.", retries=2)])):
        (tmp_path / name).mkdir()
        told = happened(tmp_path / name, script)
        assert read(tmp_path / name) == told
    assert isinstance(told[-1], CallFailed)


def test_a_run_that_had_nothing_to_do_reads_back_equal(tmp_path):
    told = []
    run = make_run([], env=Line(start=FINISH))
    with Recorder(tmp_path, run, TickingClock()) as recorder:
        run.solve(lambda event: (recorder(event), told.append(event)))
    assert [type(event) for event in told] == [RunStarted, RunEnded]
    assert read(tmp_path) == told
    assert list(read_exchanges(tmp_path)) == []


def test_the_plan_of_a_solved_run_is_known_also_without_its_file(tmp_path):
    told = happened(tmp_path, SOLVES)
    (tmp_path / "plan.json").unlink()
    assert read(tmp_path) == told


def test_the_times_are_those_of_the_lines(tmp_path):
    record(tmp_path, SOLVES)
    lines = (tmp_path / "events.jsonl").read_text(encoding="utf-8").splitlines()[1:]
    assert [recorded.time for recorded in read_events(tmp_path)] == [json.loads(line)["time"] for line in lines]


# ---- run.json ------------------------------------------------------------------------------------------------------


def test_what_was_asked_and_what_came_of_it_reads_back(tmp_path):
    result = record(tmp_path, SOLVES)
    found = read_run(tmp_path)
    assert (found.status, found.stop, found.stats) == ("solved", "solved", result.stats)
    assert found.config == replace(make_run(SOLVES).config)
    assert (found.instance, found.options) == ({"start": 0.0}, {"ground": "wet", "colour": "red"})


@pytest.mark.parametrize(
    ("change", "wrong"),
    [
        ({"format": "llm3-run/9"}, "the format is 'llm3-run/9', and this version reads 'llm3-run/1'"),
        (
            {"status": "happy"},
            "Invalid enum value 'happy' - at "
            "`$.status`; valid: 'error', 'interrupted', 'not solved', 'running', 'solved'",
        ),
        ({"seconds": "one"}, 'Expected `float`, got `str` "one" - at `$.seconds`'),
        ({"config": {"domain": "line", "temperature": -1}}, "the temperature must be 0 or more, not -1."),
    ],
)
def test_a_run_file_in_another_form_is_refused(tmp_path, change, wrong):
    record(tmp_path, SOLVES)
    path = tmp_path / "run.json"
    path.write_text(json.dumps({**json.loads(path.read_text(encoding="utf-8")), **change}), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read_run(tmp_path)
    assert str(caught.value) == f"{path}: {wrong}"


def test_what_is_no_folder_of_a_run_is_named(tmp_path):
    with pytest.raises(InputError) as caught:
        read_run(tmp_path)
    assert str(caught.value) == f"'{tmp_path}' holds no run.json: it is not the folder of a run."
    with pytest.raises(InputError) as caught:
        read_run(tmp_path / "nowhere")
    assert str(caught.value) == f"{tmp_path / 'nowhere'}: No such file or directory"


# ---- damage --------------------------------------------------------------------------------------------------------

COMPLETION = {"text": "", "stats": {}, "model": "", "finish_reason": "", "reasoning": "", "notes": []}


def replaced(number, old, new):
    """Changes a text in one line; line 1 is the header."""
    return lambda lines: [line.replace(old, new) if n == number else line for n, line in enumerate(lines, 1)]


@pytest.mark.parametrize(
    ("damage", "wrong"),
    [
        (replaced(1, "llm3-events/1", "llm3-events/9"),
         "line 1: the format is 'llm3-events/9', and this version reads 'llm3-events/1'"),
        (lambda lines: lines[1:], "line 1: Object missing required field `format`"),
        (replaced(2, '"RunStarted"', '"RunBegun"'), "line 2: unknown event 'RunBegun'. Known: RunStarted, PromptSent, "
         "ReplyReceived, CallFailed, ReplyRead, ActionTried, AttemptEnded, RunEnded."),
        (replaced(2, '"RunStarted"', "null"), "line 2: unknown event None. Known: RunStarted, PromptSent, "
         "ReplyReceived, CallFailed, ReplyRead, ActionTried, AttemptEnded, RunEnded."),
        (replaced(3, '"user"', '"nobody"'), "line 3: Invalid enum value 'nobody' - at "
        "`$.messages[1].role`; valid: 'assistant', 'system', 'user'"),
        (replaced(3, '"attempt":1', '"attempt":2'), "line 3: the attempt is number 1, not 2"),
        (replaced(4, '"text"', '"word"'), "line 4: Object missing required field `text` - at `$.completion`"),
        (replaced(5, '"repairs"', '"mends"'),
         "line 5, proposal: Object missing required field `repairs`"),
        (replaced(5, '{"name":"go","objects":[],"params":{"x":5.0}}', "7"),
         "line 5, action: Expected `object`, got `int` 7"),
        (replaced(6, '"index":0', '"index":1'), "line 6: the index of the action is 0, not 1"),
        (replaced(6, '"failure"', '"fail"'), "line 6: Object missing required field `failure` - at `$.outcome`"),
        (replaced(7, ":", ";"), "line 7: JSON is malformed: expected ':' (column 9)"),
        (lambda lines: lines[:4] + lines[5:], "line 5: ActionTried cannot follow ReplyReceived"),
        (lambda lines: lines[:1] + lines[2:], "line 2: PromptSent cannot follow the header"),
        (lambda lines: [*lines[:3], "", *lines[3:]], "line 4: empty"),
    ],
)  # fmt: skip
def test_any_other_damage_is_named_with_its_line(tmp_path, damage, wrong):
    happened(tmp_path, SOLVES)
    path = tmp_path / "events.jsonl"
    lines = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join(damage(lines)) + "\n", encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read(tmp_path)
    assert str(caught.value) == f"{path}, {wrong}"


def test_a_reused_action_that_was_never_tried_is_damage(tmp_path):
    told = happened(tmp_path, [reply(go(1), take("coin"))] * 2 + [reply(go(1), go(FINISH))])
    assert told[-1].result.solved
    path = tmp_path / "events.jsonl"
    lines = path.read_text(encoding="utf-8").splitlines()
    first = next(n for n, line in enumerate(lines) if '"ActionTried"' in line)
    line = json.loads(lines[first])
    del line["step"]
    lines[first] = json.dumps(line)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    with pytest.raises(InputError) as caught:
        read(tmp_path)
    assert str(caught.value) == (
        f"{path}, line {first + 1}: neither this line nor an earlier one tells how go([], {{'x': 1.0}}) was done"
    )


def test_a_record_without_events_is_named(tmp_path):
    record(tmp_path, SOLVES)
    (tmp_path / "events.jsonl").unlink()
    with pytest.raises(InputError) as caught:
        read(tmp_path)
    assert str(caught.value) == f"{tmp_path / 'events.jsonl'}: No such file or directory"


# ---- exchanges -----------------------------------------------------------------------------------------------------


def test_the_exchanges_of_a_record_are_its_prompts_and_replies(tmp_path):
    told = happened(tmp_path, [*SOLVES[:2], BackendError("gone.", retries=2)])
    exchanges = list(read_exchanges(tmp_path))
    assert [e.request.messages for e in exchanges] == [e.messages for e in told if isinstance(e, PromptSent)]
    replies = [e.completion.text for e in told if isinstance(e, ReplyReceived)]
    assert [e.completion.text for e in exchanges[:2]] == replies == SOLVES[:2]
    assert (exchanges[2].completion, exchanges[2].error, exchanges[2].usage.retries) == (None, "gone.", 2)
    assert [e.number for e in exchanges] == [1, 2, 3]
    assert {e.run for e in exchanges} == {"line/far/5/backtrack/categorized"}
    assert all(e.seconds > 0 for e in exchanges)
