"""What is shown of two prompts leads from the one to the other."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from llm3.report import Line, changes
from llm3.types import Message

texts = st.lists(st.sampled_from(["a", "b", "c", "", "the same"]), max_size=12).map("\n".join)
prompts = st.lists(st.builds(Message, st.sampled_from(["system", "user"]), texts), min_size=1, max_size=3)


def lines(prompt):
    return [line for message in prompt for line in (f"[{message.role}]", *message.content.splitlines())]


def is_within(part, whole):
    """Whether it is the whole with some lines left out."""
    rest = iter(whole)
    return all(line in rest for line in part)


@given(prompts)
def test_nothing_is_shown_of_the_same_prompt(prompt):
    assert list(changes(prompt, prompt)) == []


@given(prompts, prompts)
def test_what_is_shown_stands_in_the_prompts_in_that_order(before, after):
    shown = list(changes(before, after))
    assert is_within([line.text for line in shown if line.kind in ("kept", "added")], lines(after))
    assert is_within([line.text for line in shown if line.kind in ("kept", "removed")], lines(before))


@given(prompts, prompts)
def test_nothing_that_changed_is_left_out(before, after):
    shown = list(changes(before, after))
    gone = sum(line.kind == "removed" for line in shown)
    come = sum(line.kind == "added" for line in shown)
    assert len(lines(before)) - gone == len(lines(after)) - come
    assert bool(shown) == (lines(before) != lines(after))


def test_what_stayed_is_shown_one_line_around_what_changed():
    before = [Message("user", "one\ntwo\nthree\nfour\nfive\nsix\nseven")]
    after = [Message("user", "one\n2\nthree\nfour\nfive\nsix\n7")]
    assert list(changes(before, after)) == [
        Line("kept", "one"),
        Line("removed", "two"),
        Line("added", "2"),
        Line("kept", "three"),
        Line("left out"),
        Line("kept", "six"),
        Line("removed", "seven"),
        Line("added", "7"),
    ]
