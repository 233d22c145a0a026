"""Every fault that the model server can produce is what it is called."""

import pytest
import requests
from chat_client import ASKED, PLAN, ask, said

from llm3.errors import UnknownName
from llm3.testing import REPLY_FAULTS, WIRE_FAULTS, Faults, LLMServer


@pytest.mark.parametrize("fault", REPLY_FAULTS)
def test_every_fault_of_a_reply_can_be_sent(fault):
    with LLMServer(lambda _: PLAN, faults=Faults.at({2: fault})) as server:
        first, bad, third = (ask(server).json()["choices"][0] for _ in range(3))
    assert first == third
    assert bad["message"] != first["message"] or fault == "same plan again"
    assert bad["finish_reason"] == ("length" if fault == "truncated JSON" else "stop")
    assert server.answers == ["reply", fault, "reply"]


def test_a_refusal_is_sent_as_one():
    with LLMServer([PLAN], faults=Faults.at({1: "refusal"})) as server:
        message = ask(server).json()["choices"][0]["message"]
    assert message == {"role": "assistant", "content": None, "refusal": "I'm sorry, but I can't help with that."}


WHAT_COMES = {
    "429": 429,
    "429 with Retry-After": 429,
    "500": 500,
    "503": 503,
    "timeout": requests.Timeout,
    "dropped connection": requests.ConnectionError,
    "broken JSON envelope": requests.exceptions.JSONDecodeError,
    "slow, byte by byte": requests.exceptions.ReadTimeout,
}


def outcome(server, fault):
    try:
        if fault == "slow, byte by byte":  # each byte comes in time: the client has to look at the clock
            with requests.post(f"{server.url}/chat/completions", json=ASKED, timeout=10, stream=True) as response:
                pieces = response.iter_content(1)
                assert [next(pieces) for _ in range(3)] == [b"{", b" ", b" "]
                return requests.exceptions.ReadTimeout
        response = ask(server, timeout=0.2 if fault == "timeout" else 10)
        if response.status_code == 200:
            response.json()
        assert ("Retry-After" in response.headers) == (fault == "429 with Retry-After")
        return response.status_code
    except requests.RequestException as error:
        return next(kind for kind in WHAT_COMES.values() if isinstance(kind, type) and isinstance(error, kind))


def test_every_fault_of_the_wire_is_known():
    assert set(WHAT_COMES) == set(WIRE_FAULTS)


@pytest.mark.parametrize("fault", WHAT_COMES)
def test_a_fault_of_the_wire_takes_no_reply_from_the_script(fault):
    with LLMServer(["one"], faults=Faults.at({1: fault})) as server:
        assert outcome(server, fault) == WHAT_COMES[fault]
        assert said(ask(server)) == "one"
    assert server.answers == [fault, "reply"]


def test_an_unknown_fault_is_refused():
    with pytest.raises(UnknownName) as caught:
        LLMServer(["one"], faults=Faults.at({1: "nan"}))
    known = ", ".join(sorted([*REPLY_FAULTS, *WIRE_FAULTS]))
    assert str(caught.value) == f"unknown fault 'nan'. Known: {known}."
