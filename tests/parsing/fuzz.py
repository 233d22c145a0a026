"""Mutated replies for the parser: it must answer every one with a value, in a time that grows with the length alone.

python tests/parsing/fuzz.py --replies 2000000
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from time import perf_counter, process_time

import numpy as np
from parsing_world import PLAN_TEXTS, SCHEMAS, parse, reply

from llm3.parsing import reply_schema
from llm3.types import Action, Failure, FailureKind, Proposal, Rejected, Sketch

LONGEST = 200_000
"""Characters that are read; longer replies are refused unread."""
BATCH = 10_000
"""Replies that are drawn from one seed."""
SKELETON = (Sketch("pick", ("red_box",)), Sketch("place", ("red_box",)))
GOOD = (
    reply(*PLAN_TEXTS),
    json.dumps(json.loads(reply(*PLAN_TEXTS)), indent=2),
    str(json.loads(reply(*PLAN_TEXTS))),
    reply({"action": "place", "objects": ["red_box"], "params": {"x": 0.5, "y": 0, "theta": 1}}, "wait()"),
    json.dumps(list(PLAN_TEXTS)),
    f"Well,\n```json\n{reply(*PLAN_TEXTS)}\n```\nvoilà",
    f"<think>\nFirst [pick] it, then {{place}} it.\n</think>\n\n{reply(*PLAN_TEXTS[:2])}",
)
BAD = (
    "I'm sorry, but I can't help with that.",
    "To pack the boxes:\n1. pick(['red_box'], {})\n2. place(['red_box'], {'x': 0.5, 'y': 0, 'theta': 0})\n3. wait()",
    '{"Reasoning": "The red box, e.g. "red_box", is first.", "Full Plan": ["pick([\'red_box\'], {})",]}',
    '{"Reasoning": "because", "Full Plan": ["pick([\'red_box\'], {})", "place([\'red_box\'], {\'x\': 0.5, \'y\': ',
    "{'Full Plan': [pick([red_box], {}), place([red_box], {x: NaN, y: -Infinity, theta: 1e999})]}",
    '{"plan": "pick(red_box); place(red_box, x=0.5, y=0, theta=pi/2)"} // or so',
    '{"Full Plan": {"1": "pick([\\"red_box\\"], {})", "2": ["place", ["red_box"], {"x": 0.5}]}}',
    "```python\nplan = [\n    pick(['red_box']),  # the first\n    wait(),\n]\n```",
    json.dumps({"type": "object", "schema": reply_schema(SCHEMAS, ("red_box", "blue_box"))}),
    "",
)
PIECES = (
    *"{}[]()'\"`,:;=\\/#*\n\t 019-+.eE_…“”‘’«»éß中\x00\x7f\u200b\u2028\ufeff\ud83d\ude00\U0001f4e6",
    *('"Full Plan"', '"Reasoning":', "//", "/*", "*/", "```", "```json", "<think>", "</think>", "NaN", "None", "null"),
    *(
        "True",
        "\\u",
        "\\ud83d",
        "\\x",
        "0x1F",
        "1e999",
        "9" * 400,
        "pick(",
        "'red_box'",
        "x=",
        '{"plan": [',
        "...",
        "\r\n",
    ),
)
BRACKETS = ("{", "[", "(", '{"a":', "[[", "['", '["', "pick([", "}", "]", ")", '"}')

Mutation = Callable[[str, int, int, np.random.Generator], str]


def _any(choices: Sequence[str], rng: np.random.Generator) -> str:
    return choices[int(rng.random() * len(choices))]


MUTATIONS: dict[str, Mutation] = {
    "insert": lambda text, start, end, rng: text[:start] + _any(PIECES, rng) + text[start:],
    "delete": lambda text, start, end, rng: text[:start] + text[end:],
    "double": lambda text, start, end, rng: text[:end] + text[start:],
    "swap": lambda text, start, end, rng: text[end : 2 * end - start] + text[start:end] + text[:start] + text[end:],
    "truncate": lambda text, start, end, rng: text[:start],
    "behead": lambda text, start, end, rng: text[start:],
    "splice": lambda text, start, end, rng: text[:start] + _any(ALL, rng)[start:],
    "overwrite": lambda text, start, end, rng: text[:start] + _any(PIECES, rng) + text[start + 1 :],
    "unicode": lambda text, start, end, rng: text[:start] + chr(int(rng.random() * 0x110000)) + text[end:],
    "deep brackets": lambda text, start, end, rng: (
        text[:start] + _any(BRACKETS, rng) * int(100 * rng.random()) + text[end:]
    ),
}
NAMES = tuple(MUTATIONS)
ALL = GOOD + BAD


def mutated(rng: np.random.Generator) -> str:
    """A reply with one to six mutations; most of them are small."""
    text = _any(ALL, rng)
    for _ in range(1 + int(6 * rng.random() ** 3)):
        start = int(rng.random() * (len(text) + 1))
        end = min(len(text), start + int(12 * rng.random() ** -0.7) - 12)
        text = MUTATIONS[_any(NAMES, rng)](text, start, max(start, end), rng)
    return text[:LONGEST]


def check(text: str, skeleton: Sequence[Sketch] = ()) -> str:
    """Read a reply, and tell what came of it.

    Raises:
        AssertionError: The answer is no value that the loop can use.
    """
    answer = parse(text, skeleton)
    if isinstance(answer, Failure):
        assert answer.kind is FailureKind.UNREADABLE_REPLY
        assert answer.detail.isprintable()
        return "unreadable"
    assert isinstance(answer, Proposal)
    for action in answer.actions:
        assert isinstance(action, Action | Rejected)
        if isinstance(action, Rejected):
            assert action.failure.kind is FailureKind.INVALID_ACTION
            assert action.failure.detail.isprintable()
    return "mended" if answer.repairs else "read"


def fuzz(replies: int, seed: int = 0) -> Counter[str]:
    """Check so many mutated replies; what became of them.

    Raises:
        AssertionError: The parser raised something, or its answer is wrong; the message holds the reply.
    """
    rng = np.random.default_rng(seed)
    became: Counter[str] = Counter()
    for number in range(replies):
        text = mutated(rng)
        try:
            became[check(text, SKELETON if number % 8 == 0 else ())] += 1
        except Exception as error:
            raise AssertionError(f"reply {number} of seed {seed}: {text!r}") from error
    return became


def reading_times(lengths: Sequence[int], texts: int, seed: int = 0) -> list[float]:
    """Seconds of processor time to read so many replies of each length, the same ones but for their length."""
    times = []
    for length in lengths:
        rng = np.random.default_rng(seed)
        long = [_grown(length, rng) for _ in range(texts)]
        start = process_time()
        for text in long:
            parse(text)
        times.append(process_time() - start)
    return times


def _grown(length: int, rng: np.random.Generator) -> str:
    """A mutated reply, a slice of which is repeated until it has the length, with another one behind it."""
    text, answer = mutated(rng), mutated(rng)[:1000]
    start = int(rng.random() * len(text))
    piece = text[start : start + 1 + int(60 * rng.random())] or "["
    long = text[:start] + piece * (length // len(piece))
    return long[: length - len(answer)] + answer


def growth(lengths: Sequence[int], times: Sequence[float]) -> float:
    """The exponent with which time grows with length, fitted: 1 is linear, 2 is quadratic."""
    return float(np.polyfit(np.log(lengths), np.log(times), 1)[0])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--replies", type=int, default=20_000)
    parser.add_argument("--seed", type=int, default=0, help=f"of the first {BATCH} replies; the next seeds follow")
    parser.add_argument("--jobs", type=int, default=1, help="processes at a time")
    arguments = parser.parse_args()
    start = perf_counter()
    left = arguments.replies
    batches = [min(BATCH, left - done) for done in range(0, left, BATCH)]
    seeds = range(arguments.seed, arguments.seed + len(batches))
    with ProcessPoolExecutor(arguments.jobs) as pool:
        became = sum(pool.map(fuzz, batches, seeds), Counter())
    seconds = perf_counter() - start
    counts = ", ".join(f"{count} {what}" for what, count in became.most_common())
    sys.stdout.write(f"{arguments.replies} replies in {seconds:.0f} s, {arguments.replies / seconds:.0f}/s: {counts}\n")
    lengths = [LONGEST // 16, LONGEST // 8, LONGEST // 4, LONGEST // 2, LONGEST]
    times = reading_times(lengths, 20, arguments.seed)
    row = ", ".join(f"{length}: {1e3 * t / 20:.1f} ms" for length, t in zip(lengths, times, strict=True))
    sys.stdout.write(
        f"time to read a reply by its characters: {row}; it grows as length^{growth(lengths, times):.2f}\n"
    )


if __name__ == "__main__":
    main()
