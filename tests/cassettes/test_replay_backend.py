"""What `replay` answers: the recorded reply of the same run to the same prompt, for each time it was sent."""

from __future__ import annotations

from functools import cache

import pytest
from cassette_maker import CONFIG, Model, tape
from hypothesis import given
from hypothesis import strategies as st

from llm3 import BackendSettings, Registry, RunConfig
from llm3.errors import BackendError, UsageError
from llm3.records import read_cassette
from llm3.types import Completion, Context, Message, Request, Stats

RUN = CONFIG.run_name


def prompt(text, system="Plan."):
    return (Message("system", system), Message("user", text))


def request(text, system="Plan."):
    return Request(prompt(text, system), Context("", (), (), ()))


registry = cache(Registry.discover)


def replay(path, run=RUN, **settings):
    return registry().backend("replay", BackendSettings(argument=str(path), run=run, **settings))


def refusal(backend, *texts):
    """The sentence in which the last of these prompts ends."""
    *before, last = texts
    for text in before:
        backend.complete(request(text))
    with pytest.raises(BackendError) as caught:
        backend.complete(request(last))
    return str(caught.value)


def refused(*arguments, **settings):
    with pytest.raises(UsageError) as caught:
        replay(*arguments, **settings)
    return str(caught.value)


# ---- answers -------------------------------------------------------------------------------------------------------


@given(st.lists(st.sampled_from("abc"), max_size=8))
def test_each_prompt_gets_its_reply_and_the_same_prompt_the_next_one(tmp_path_factory, asked):
    path = tmp_path_factory.mktemp("tape") / "t"
    replies = [Completion(f"reply {number}") for number in range(len(asked))]
    backend = replay(tape(path, [(prompt(text), reply) for text, reply in zip(asked, replies, strict=True)]))
    assert [backend.complete(request(text)) for text in asked] == replies
    count = f"{len(asked)} prompt{'s' * (len(asked) != 1)}"
    assert backend.last_words == f"the run repeated its recording: {count}."


def test_the_whole_completion_comes_back(tmp_path):
    spent = Stats(prompt_tokens=5, cached_tokens=1, completion_tokens=3, reasoning_tokens=2, retries=1, step_downs=1)
    said = Completion("a", spent, "gpt-1", "length", "hm", ("waited 1 s",))
    assert replay(tape(tmp_path / "t", [(prompt("x"), said)])).complete(request("x")) == said


def test_many_runs_fit_into_one_cassette(tmp_path):
    other = RunConfig("corridor", "default", 7, feedback="binary", model="gpt", temperature=0, max_reply_tokens=99)
    one = tape(tmp_path / "1", [(prompt("x"), Completion("one"))])
    two = tape(tmp_path / "2", [(prompt("x"), Completion("two"))], other)
    both = tmp_path / "both"
    both.write_bytes(one.read_bytes() + two.read_bytes())
    assert replay(both).complete(request("x")).text == "one"
    assert replay(both, other.run_name).complete(request("x")).text == "two"


def test_who_names_no_run_gets_whatever_was_answered_to_the_prompt(tmp_path):
    backend = replay(tape(tmp_path / "t", [(prompt("x"), Completion("a"))]), run="")
    assert backend.complete(request("x")).text == "a"


def test_a_failed_call_fails_again(tmp_path):
    backend = replay(tape(tmp_path / "t", [(prompt("x"), "no server answers.")]))
    with pytest.raises(BackendError) as caught:
        backend.complete(request("x"))
    assert str(caught.value) == f"the call failed in the recording '{tmp_path / 't'}', too: no server answers."
    assert caught.value.retries == 3


# ---- what is not there ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("recorded", "asked", "sentence"),
    [
        (["a"], ["a", "a"], "prompt 2 is in the recording '{path}' once only, and asked once more."),
        (["a", "a"], ["a"] * 3, "prompt 3 is in the recording '{path}' 2 times only, and asked once more."),
        ([], ["a"], "the recording '{path}' holds no prompt at all."),
        (["one\ntwo\nthree", "one\n2\n3"], ["one\n2\nthree\nfour"],
         "prompt 1 of run '{run}' is not in the recording '{path}'; the nearest is prompt 1 of run '{run}': "
         "line 2 of the user message is 'two' there and '2' here."),
        (["one\ntwo\nthree", "one\n2\n3"], ["one\n2\n3\nfour"],
         "prompt 1 of run '{run}' is not in the recording '{path}'; the nearest is prompt 2 of run '{run}': "
         "line 4 of the user message stands here only: 'four'."),
        (["one\ntwo"], ["one"],
         "prompt 1 of run '{run}' is not in the recording '{path}'; the nearest is prompt 1 of run '{run}': "
         "line 2 of the user message stands there only: 'two'."),
        (["x" * 300 + "a" + "y" * 300], ["x" * 300 + "b\x07"],
         "prompt 1 of run '{run}' is not in the recording '{path}'; the nearest is prompt 1 of run '{run}': "
         f"line 1 of the user message is '…{'x' * 30}a{'y' * 49}…' there and '…{'x' * 30}b\\x07' here."),
    ],
)  # fmt: skip
def test_a_prompt_that_is_not_there_names_the_nearest(tmp_path, recorded, asked, sentence):
    path = tape(tmp_path / "t", [(prompt(text), Completion("a")) for text in recorded])
    assert refusal(replay(path), *asked) == sentence.format(path=path, run=RUN)


def test_the_same_prompt_of_another_run_is_none_of_this_one(tmp_path):
    path = tape(tmp_path / "t", [(prompt("x"), Completion("a"))])
    assert refusal(replay(path, "corridor/default/8/backtrack/binary"), "x") == (
        f"prompt 1 of run 'corridor/default/8/backtrack/binary' is not in the recording '{path}'; "
        f"the nearest is prompt 1 of run '{RUN}': the prompts are the same, the runs are not."
    )


def test_a_run_that_asks_less_did_not_repeat_its_recording(tmp_path):
    path = tape(tmp_path / "t", [(prompt(text), Completion("a")) for text in "abc"])
    backend = replay(path)
    backend.complete(request("a"))
    assert backend.last_words == f"the run parted from its recording: it ended after 1 prompt, and '{path}' has 3."


# ---- what it says of the model -------------------------------------------------------------------------------------


def test_it_is_a_language_model_if_one_was_recorded(tmp_path):
    one = replay(tape(tmp_path / "1", [(prompt("x"), Completion("a"))], backend=Model([])))
    assert one.is_language_model
    assert one.notice == f"No model is asked: the replies of gpt are replayed from '{tmp_path / '1'}'."
    other = replay(tape(tmp_path / "2", [(prompt("x"), Completion("a"))]))
    assert not other.is_language_model
    assert other.notice == (
        f"No language model is used: the replies are replayed from '{tmp_path / '2'}', recorded without one."
    )


def test_the_settings_of_the_model_are_those_of_the_recording(tmp_path):
    path = tape(tmp_path / "t", [(prompt("x"), Completion("a"))])
    for settings in ({}, {"model": "gpt"}, {"temperature": 0.0}, {"max_reply_tokens": 99, "model": "gpt"}):
        assert replay(path, **settings).complete(request("x")).text == "a"
    assert refused(path, model="gemini") == (
        f"the recording '{path}' was made with --model gpt --temperature 0.0 --max-reply-tokens 99, "
        "not with --model gemini: leave the latter out."
    )


def test_between_several_models_the_user_chooses(tmp_path):
    paths = [
        tape(tmp_path / name, [(prompt("x"), Completion(name))], RunConfig("corridor", "default", 7, model=name))
        for name in ("gpt", "gemini")
    ]
    both = tmp_path / "both"
    both.write_bytes(b"".join(path.read_bytes() for path in paths))
    assert len(list(read_cassette(both))) == 2
    assert replay(both, model="gemini").complete(request("x")).text == "gemini"
    assert refused(both) == f"the recording '{both}' holds several: --model gpt; --model gemini. Choose one of them."
