"""The file of a cassette: what is written reads back, whole or up to where it was cut off."""

from __future__ import annotations

import hashlib
import json
import re
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from cassette_maker import run_of, tape
from hypothesis import given, settings
from hypothesis import strategies as st

from llm3.assembly import RunConfig
from llm3.errors import InputError, LLM3Error, OutputExists
from llm3.records import CassetteRecorder, check_cassette, read_cassette
from llm3.types import Completion, Message, PromptSent, ReplyReceived, Stats

counts = st.integers(0, 10**6)
spent = st.builds(
    Stats, prompt_tokens=counts, cached_tokens=counts, completion_tokens=counts, reasoning_tokens=counts,
    retries=counts, step_downs=counts,
)  # fmt: skip
texts = st.text(max_size=9)
completions = st.builds(Completion, texts, spent, texts, texts, texts, st.lists(texts, max_size=2).map(tuple))
messages = st.lists(st.builds(Message, st.sampled_from(["system", "user", "assistant"]), texts), max_size=3).map(tuple)
conversations = st.lists(st.tuples(messages, completions | texts), max_size=3)


PROMPT = (Message("system", "Plan."), Message("user", "größer\n\x07"))
TALK = [(PROMPT, Completion("a", Stats(prompt_tokens=5), "gpt-1", "stop", "hm", ("waited 1 s",))), (PROMPT, "gone.")]


@given(conversations)
@settings(max_examples=40)
def test_what_is_recorded_reads_back_equal(conversation):
    with TemporaryDirectory() as name:
        exchanges = list(read_cassette(tape(Path(name) / "t", conversation)))
    assert [e.request.messages for e in exchanges] == [asked for asked, _ in conversation]
    assert [e.completion or e.error for e in exchanges] == [answer for _, answer in conversation]
    assert [e.number for e in exchanges] == list(range(1, len(conversation) + 1))


@given(conversations, st.floats(0, 1))
@settings(max_examples=40)
def test_wherever_the_file_is_cut_off_what_came_before_can_be_read(conversation, share):
    with TemporaryDirectory() as name:
        path = tape(Path(name) / "t", conversation)
        whole, exchanges = path.read_bytes(), list(read_cassette(path))
        left = whole[: round(share * len(whole))]
        path.write_bytes(left)
        complete = left.count(b"\n") + (whole[len(left) :][:1] == b"\n")
        assert list(read_cassette(path)) == exchanges[: max(0, complete - 1)]


@given(conversations, conversations, st.none() | st.floats(0, 1))
@settings(max_examples=40)
def test_cassettes_can_be_joined_also_after_one_that_was_cut_off(one, other, share):
    with TemporaryDirectory() as name:
        first, second = tape(Path(name) / "1", one), tape(Path(name) / "2", other)
        if share is not None:
            whole = first.read_bytes()
            first.write_bytes(whole[: whole.rindex(b"\n", 0, max(len(whole) // 2, 30)) + 1 + round(share * 20)])
        left = first.read_bytes()
        left = left if left.endswith(b"\n") else left[: left.rindex(b"\n") + 1]
        both = Path(name) / "both"
        both.write_bytes(first.read_bytes() + second.read_bytes())
        first.write_bytes(left)
        assert list(read_cassette(both)) == [*read_cassette(first), *read_cassette(second)]


@pytest.mark.parametrize("text", [b"hello", b"\x00\xff\x12", b'{"run": "x"}', b"hello\nworld\n"])
def test_what_is_no_cassette_is_refused(tmp_path, text):
    path = tmp_path / "tape"
    path.write_bytes(text)
    with pytest.raises(InputError, match=rf"^{re.escape(str(path))}, line 1: "):
        list(read_cassette(path))


@given(messages, st.none() | st.sampled_from(["gpt", "größer"]), st.none() | st.sampled_from([0, 0.7, 1]))
@settings(max_examples=40)
def test_the_digest_is_the_sha_256_of_the_request_as_plain_json(asked, model, temperature):
    config = RunConfig("corridor", model=model, temperature=temperature)
    with TemporaryDirectory() as name:
        lines = tape(Path(name) / "t", [(asked, Completion("a"))], config).read_text(encoding="utf-8").split("\n")
    line = json.loads(lines[1])
    plain = json.dumps(line["request"], sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    assert line["digest"] == hashlib.sha256(plain.encode()).hexdigest()


def test_a_line_holds_the_whole_exchange(tmp_path):
    head, first, second = map(json.loads, tape(tmp_path / "t", TALK).read_text(encoding="utf-8").splitlines())
    assert head == {"format": "llm3-cassette/1"}
    assert len(first.pop("digest")) == 64
    assert first == {
        "run": "corridor/default/7/backtrack/categorized",
        "number": 1,
        "language_model": False,
        "request": {
            "messages": [{"role": m.role, "content": m.content} for m in PROMPT],
            "model": "gpt",
            "temperature": 0.0,
            "max_reply_tokens": 99,
        },
        "reply": {"text": "a", "reasoning": "hm", "finish_reason": "stop", "model": "gpt-1"},
        "error": "",
        "usage": {
            "prompt_tokens": 5,
            "cached_tokens": 0,
            "completion_tokens": 0,
            "reasoning_tokens": 0,
            "retries": 0,
            "step_downs": 0,
        },
        "seconds": 1.0,
        "notes": ["waited 1 s"],
    }
    assert (second["reply"], second["error"], second["usage"]["retries"]) == (None, "gone.", 3)


def test_every_exchange_is_on_disk_as_soon_as_it_is_over(tmp_path):
    with CassetteRecorder(tmp_path / "t", run_of()) as observe:
        for number in range(1, 4):
            observe(PromptSent(number, PROMPT))
            assert len(list(read_cassette(tmp_path / "t"))) == number - 1
            observe(ReplyReceived(number, Completion("a")))
            assert len(list(read_cassette(tmp_path / "t"))) == number


@pytest.mark.parametrize(
    ("line", "old", "new", "wrong"),
    [
        (1, "llm3-cassette/1", "llm3-cassette/9",
         "line 1: the format is 'llm3-cassette/9', and this version reads 'llm3-cassette/1'"),
        (2, '"Plan."', '"Pack."', "line 2: the digest is not that of the request, "
         "2f110fa8d6674e149d2945cea570f4a2ccbdb07c3848ed2bf4e4ed764b6585a7"),
        (2, '"usage"', '"prices"', "line 2: Object missing required field `usage`"),
        (2, '"run"', '"walk"', "line 2: Object missing required field `run`"),
        (3, '"number":2', '"number":2,"key":1', "line 3: unknown field `key`, expected run, number, language_model, "
         "request, digest, reply, error, usage, seconds, notes - at `$`"),
    ],
)  # fmt: skip
def test_damage_is_named_with_its_line(tmp_path, line, old, new, wrong):
    path = tape(tmp_path / "t", TALK)
    lines = path.read_text(encoding="utf-8").split("\n")
    lines[line - 1] = lines[line - 1].replace(old, new)
    path.write_text("\n".join(lines), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        list(read_cassette(path))
    assert str(caught.value) == f"{path}, {wrong}"


def test_another_cassette_is_not_overwritten_unless_asked(tmp_path):
    path = tape(tmp_path / "t", TALK)
    with pytest.raises(OutputExists) as caught:
        tape(path, [])
    assert str(caught.value) == f"the cassette '{path}' exists: choose another file, or give --force."
    assert len(list(read_cassette(path))) == 2
    assert list(read_cassette(tape(path, [], force=True))) == []


def test_a_place_that_cannot_be_written_is_named(tmp_path):
    (tmp_path / "file").write_text("", encoding="utf-8")
    for path, reason in (
        (tmp_path, f"'{tmp_path}' is a folder, so no cassette can be written there."),
        (tmp_path / "file/t", f"the cassette '{tmp_path / 'file/t'}' cannot be written: Not a directory."),
    ):
        with pytest.raises(LLM3Error) as caught:
            tape(path, TALK)
        assert str(caught.value) == reason
    check_cassette(tmp_path / "new/t", force=False)
    assert not (tmp_path / "new").exists()
