"""The backend `litellm` on a function in place of the library's: what is sent, read, asked again and kept secret."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from llm3.errors import BackendError, UsageError
from llm3.interfaces import BackendSettings
from llm3.types import Completion, Context, Message, Request, Stats
from llm3_litellm.backend import ATTEMPTS, LiteLLMBackend
from llm3_litellm.plugin import llm3_backends

REQUEST = Request((Message("system", "be brief"), Message("user", "plan")), Context("", (), (), ()))
KEY = "sk-canary-0123456789"


class Busy(Exception):
    status_code = 429


class Refused(Exception):
    status_code = 401


def answer(text="a plan", **message):
    usage = SimpleNamespace(
        prompt_tokens=30,
        completion_tokens=20,
        prompt_tokens_details=SimpleNamespace(cached_tokens=10),
        completion_tokens_details=SimpleNamespace(reasoning_tokens=5),
    )
    choice = SimpleNamespace(message=SimpleNamespace(content=text, **message), finish_reason="stop")
    return SimpleNamespace(choices=[choice], usage=usage, model="served-name")


class Library:
    """Answers or raises what it is told, and keeps what it was asked."""

    def __init__(self, *script):
        self.script, self.asked = list(script), []

    def completion(self, **arguments):
        self.asked.append(arguments)
        reply = self.script.pop(0)
        if isinstance(reply, Exception):
            raise reply
        return reply


def backend(library, slept=None, environment=None, **settings):
    return LiteLLMBackend(
        BackendSettings(model="bedrock/some-model", **settings),
        library.completion,
        environment or {},
        rng=np.random.default_rng(0),
        sleep=(slept if slept is not None else []).append,
        clock=lambda: 0.0,
    )


def test_the_messages_are_sent_and_nothing_that_was_not_asked_for():
    library = Library(answer())
    backend(library).complete(REQUEST)
    (asked,) = library.asked
    assert asked == {
        "model": "bedrock/some-model",
        "messages": [{"role": "system", "content": "be brief"}, {"role": "user", "content": "plan"}],
        "timeout": 900.0,
        "num_retries": 0,
        "max_retries": 0,
    }


def test_what_was_asked_for_is_sent():
    library = Library(answer())
    backend(library, temperature=0.5, max_reply_tokens=100).complete(REQUEST)
    assert (library.asked[0]["temperature"], library.asked[0]["max_tokens"]) == (0.5, 100)


def test_the_answer_is_read_with_what_it_cost():
    assert backend(Library(answer(reasoning_content="hm"))).complete(REQUEST) == Completion(
        "a plan",
        Stats(prompt_tokens=30, cached_tokens=10, completion_tokens=20, reasoning_tokens=5),
        "served-name",
        "stop",
        "hm",
    )


def test_a_model_that_says_nothing_has_answered():
    assert backend(Library(answer(None))).complete(REQUEST).text == ""


def test_what_may_pass_is_asked_again_and_noted():
    slept = []
    done = backend(Library(Busy("slow down"), Busy("slow down"), answer()), slept).complete(REQUEST)
    assert done.stats.retries == len(done.notes) == len(slept) == 2
    assert 0.5 <= slept[0] <= 1.0 <= slept[1] <= 2.0
    assert done.notes[0] == f"Busy: slow down; asked again after {slept[0]:.1f} s"


@pytest.mark.parametrize(("error", "requests"), [(Refused("no such key"), 1), (Busy("slow down"), ATTEMPTS)])
def test_what_does_not_pass_is_one_line_that_counts_its_requests(error, requests):
    library = Library(*[error] * requests)
    with pytest.raises(BackendError) as caught:
        backend(library).complete(REQUEST)
    assert str(caught.value) == f"LiteLLM gets no answer from 'bedrock/some-model': {type(error).__name__}: {error}"
    assert caught.value.retries == len(library.asked) == requests


def test_a_wait_that_would_end_too_late_is_not_begun():
    library, slept = Library(Busy("slow down")), []
    with pytest.raises(BackendError) as caught:
        backend(library, slept).complete(Request(REQUEST.messages, REQUEST.context, seconds=0.1))
    assert caught.value.out_of_time
    assert (slept, library.asked[0]["timeout"]) == ([], 0.1)


def test_keys_are_nowhere():
    environment = {"SOME_API_KEY": KEY, "A_TOKEN": KEY[:12], "HOME": "/home/me", "KEYMAP": "red_block"}
    assert backend(Library(answer("red_block")), environment=environment).complete(REQUEST).text == "red_block"
    done = backend(Library(Busy(f"bad {KEY}"), answer(f"I am {KEY}")), environment=environment).complete(REQUEST)
    assert KEY not in repr(done)
    with pytest.raises(BackendError) as caught:
        backend(Library(Refused(f"bad {KEY}")), environment=environment).complete(REQUEST)
    assert str(caught.value).endswith("Refused: bad ***")


@pytest.mark.parametrize("choices", [[], None, [SimpleNamespace(message=None)]])
def test_an_answer_without_a_message_is_one_line(choices):
    with pytest.raises(BackendError) as caught:
        backend(Library(SimpleNamespace(choices=choices))).complete(REQUEST)
    assert str(caught.value) == (
        "LiteLLM's answer from 'bedrock/some-model' has no message in it: give another --model"
    )
    assert caught.value.retries == 1


def test_content_in_parts_is_joined_and_half_a_surrogate_pair_replaced():
    odd = answer([{"type": "text", "text": "a "}, {"type": "text", "text": "plan"}, {"type": "image"}])
    odd.model = "\ud800"
    told = backend(Library(odd)).complete(REQUEST)
    assert (told.text, told.model) == ("a plan", "?")


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({}, "the backend 'litellm' needs the name of a model: give --model PROVIDER/NAME."),
        ({"model": "x", "argument": "y"}, "the backend 'litellm' takes no argument, so leave out ':y'."),
    ],
)
def test_what_it_cannot_do_is_one_line(settings, sentence):
    with pytest.raises(UsageError) as caught:
        llm3_backends()["litellm"](BackendSettings(**settings))
    assert str(caught.value) == sentence
