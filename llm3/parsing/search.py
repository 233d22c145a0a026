"""Finds the plan in a reply, whatever is wrapped around it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from llm3.parsing.answers import Answer, answers, best
from llm3.parsing.mending import mended
from llm3.parsing.reader import Reading, Unreadable, read

# Each bracket is tried as the start of an answer, and a failed try is paid from this budget, in characters. Chatter
# rarely costs more than itself; without a budget, text that is made of brackets would take quadratic time.
_SPARE_CHARACTERS = 20_000
_SPARE_READINGS = 1

# A bracket that an answer can begin with: behind it comes text or a comment, or an object in a list.
_OPENER = re.compile(r"\{(?=\s*[\w\"'“”„‘’‚/#])|\[(?=\s*[^\W\d]|\s*[\"'“”„‘’‚/#{])")
_END_OF_THOUGHT = re.compile(r"</think(?:ing)?>", re.IGNORECASE)
_THOUGHT = re.compile(r"\s*<think(?:ing)?>", re.IGNORECASE)


def find_answer(text: str, cut_off: bool = False) -> Answer | None:
    """The last complete answer in the text, or None if there is none, not even a damaged one.

    Where the text was cut off, a damaged answer is no answer: its plan would lack its end. Half a surrogate pair
    becomes a replacement character: no file and no server would take what is read otherwise.
    """
    text = _spoken(text.encode("utf-16", "surrogatepass").decode("utf-16", "replace"))
    answer = _best(text)
    if not cut_off and (answer is None or answer.items is None):
        answer = _best_of_mended(text) or answer
    return answer


def _spoken(text: str) -> str:
    """What follows the model's thoughts; nothing, if they never end."""
    parts = _END_OF_THOUGHT.split(text)
    return "" if len(parts) == 1 and _THOUGHT.match(text) else parts[-1]


def _best(text: str) -> Answer | None:
    return best([answer for reading in _readings(text) for answer in answers(reading)])


def _best_of_mended(text: str) -> Answer | None:
    for other, repairs in mended(text):
        answer = _best(other)
        if answer is not None and answer.items is not None:
            return replace(answer, repairs=(*repairs, *answer.repairs))
    return None


def _readings(text: str) -> Iterator[Reading]:
    """Everything in the text that can be read, outermost brackets only."""
    position, budget = 0, _SPARE_READINGS * len(text) + _SPARE_CHARACTERS
    while budget > 0 and (opener := _OPENER.search(text, position)):
        start = opener.start()
        try:
            reading = read(text, start)
        except Unreadable as failed:
            budget -= failed.position - start
            position = start + 1
        else:
            yield reading
            position = reading.end
