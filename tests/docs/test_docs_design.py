from __future__ import annotations

from docs_pages import page

from llm3.parsing import parse_reply
from llm3.types import Failure, FailureKind

PAGE = " ".join(page("design").split())


def test_the_limits_of_a_reply_are_those_of_the_parser():
    long = parse_reply("x" * 200_001, (), ())
    assert long == Failure(FailureKind.UNREADABLE_REPLY, "the reply has 200001 characters: at most 200000 are read")
    assert "A reply of more than 200,000 characters is refused" in PAGE
    many = parse_reply('{"Full Plan": [' + ", ".join(['"go([], {})"'] * 201) + "]}", (), ())
    assert many == Failure(FailureKind.UNREADABLE_REPLY, "the plan has 201 actions: at most 200 are allowed")
    assert "a plan of more than 200 actions" in PAGE
