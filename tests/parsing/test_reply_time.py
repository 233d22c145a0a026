"""Reading time grows linearly with the reply's length, whatever the text."""

import json
from statistics import median
from time import process_time

import pytest
from parsing_world import PLAN_TEXTS, parse, reply

from llm3.types import Proposal

LONG = 200_000
PATTERNS = [
    *("{", "[", '"', "'", "\\", "(", ")", "1", "-", " ", "\n", "`", "```", "#", "//", "/*", "/* ", "{}", "[]"),
    *(
        '{"',
        "['",
        '["',
        '["\\',
        "[“ ",
        "[‘[’",
        '{"a":',
        '{"a"',
        '["a",',
        "[a ",
        "{a=",
        "[(",
        "[a(",
        "[[],",
        '{"plan": [',
    ),
    *(
        "pick(",
        "pick(['red_box'], ",
        '"pick(',
        ')"',
        "<think>",
        "</think>",
        '{"Reasoning": "',
        "[1,",
        "[// \n",
        "\ud800",
    ),
    *('{"a":' * 49 + "!", "['a'," * 49 + "!", '{"action": "(",', "{'", "\\u", "é", "red_box, "),
]


def alone(pattern, length):
    return (pattern * (length // len(pattern) + 1))[:length]


def in_an_item(pattern, length):
    return json.dumps({"Full Plan": ["pick(" + alone(pattern, length // 6)]})


def as_a_value(pattern, length):
    return json.dumps({"Full Plan": [f"stack(red_box, blue_box, ratio=1{alone(pattern, length // 6)}-)"]})


def around_a_plan(pattern, length):
    text = alone(pattern, length // 2 - 1_000)
    return f"{text}\n{reply(*PLAN_TEXTS)}\n{text}"


def seconds(text):
    times = []
    for _ in range(3):
        start = process_time()
        parse(text)
        times.append(process_time() - start)
    return median(times)


@pytest.mark.slow
@pytest.mark.parametrize("shape", [alone, in_an_item, as_a_value, around_a_plan])
@pytest.mark.parametrize("pattern", PATTERNS)
def test_four_times_the_text_takes_less_than_eight_times_as_long(pattern, shape):
    short, long = (seconds(shape(pattern, length)) for length in (LONG // 4, LONG))
    assert long < 8 * short + 0.01  # below a hundredth of a second there is nothing to measure


@pytest.mark.parametrize("pattern", PATTERNS)
def test_the_longest_text_is_read(pattern):
    for shape in (alone, in_an_item, as_a_value):
        parse(shape(pattern, LONG))


def test_a_plan_in_long_chatter_is_found():
    chatter = alone("It doesn't (really) matter: {x} or [y], 'z' or \"w\". ", LONG // 2 - 1_000)
    proposal = parse(f"{chatter}\n{reply(*PLAN_TEXTS)}\n{chatter}")
    assert proposal == parse(reply(*PLAN_TEXTS))
    assert isinstance(proposal, Proposal)
