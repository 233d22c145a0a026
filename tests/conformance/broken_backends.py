"""Backends with one fault each."""

from __future__ import annotations

import random
from itertools import count

import numpy as np
from planted import Planted

from llm3 import LLMBackend
from llm3.errors import BackendError
from llm3.types import Completion, Stats


class Echo(LLMBackend):
    """No model: says that there is nothing to do."""

    is_language_model = False
    notice = "No language model is used: an echo answers."

    def complete(self, request):
        return Completion(self.text(request), self.stats())

    def text(self, request):
        return '{"Reasoning": "", "Full Plan": []}'

    def stats(self):
        return Stats()


def a_backend(**parts):
    return type("Backend", (Echo,), parts)()


def numbering():
    calls = count()
    return lambda self, request: f"reply {next(calls)}"


def refusing(self, request):
    raise BackendError("the program 'nosuchprog' is not installed")


def printing(self, request):
    print("Thinking...")  # noqa: T201  # that is the fault
    return Echo.text(self, request)


def seeding(self, request):
    random.seed(request.seed)
    return Echo.text(self, request)


def drawing(self, request):
    return f"{np.random.uniform()}"  # noqa: NPY002  # that is the fault


def closing_once(self):
    del self.connection


FAULTS: dict[str, Planted] = {
    "is_language_model is a method": Planted(
        a_backend(is_language_model=lambda self: False),
        "a backend says what it is",
        "is_language_model is <bound method …>.",
        "a property",
    ),
    "no notice": Planted(
        a_backend(notice=""),
        "a backend says what it is",
        "the backend is no language model, and its notice does not say so.",
        "fill `notice`",
    ),
    "two lines": Planted(
        a_backend(last_words="Well.\nGood-bye."),
        "a backend says what it is",
        "last_words must be one line of text, not 'Well.\\nGood-bye.'.",
        "empty for nothing to say",
    ),
    "recorded": Planted(
        a_backend(recorded=None), "a backend says what it is", "recorded must be a mapping, not None.", "RunConfig"
    ),
    "text alone": Planted(
        a_backend(complete=Echo.text),
        "requests are answered",
        'complete answers \'{"Reasoning": …',
        "Completion(text)",
    ),
    "counts calls": Planted(
        a_backend(stats=lambda self: Stats(llm_calls=1)),
        "tokens are counted and calls are not",
        "the stats of a completion have llm_calls = 1.",
        "counted twice",
    ),
    "negative tokens": Planted(
        a_backend(stats=lambda self: Stats(prompt_tokens=-1)),
        "tokens are counted and calls are not",
        "the stats of a completion have prompt_tokens = -1.",
        "from 0 on",
    ),
    "another error": Planted(
        a_backend(text=lambda self, request: 1 / 0),
        "nothing is raised",
        "Backend.complete raised ZeroDivisionError: division by zero (broken_backends.py:…).",
        "ends a run",
    ),
    "never answers": Planted(
        a_backend(text=refusing),
        "requests are answered",
        "none of 2 requests was answered: the program 'nosuchprog' is not installed",
        "The error says why",
    ),
    "draws for itself": Planted(
        a_backend(text=numbering()),
        "equal requests get equal answers",
        "two equal requests get 'reply 0' and then 'reply 2'.",
        "request.seed",
    ),
    "an empty text": Planted(
        a_backend(text=lambda self, request: " \n"),
        "requests are answered",
        "a request is answered with an empty text.",
        "raise a BackendError",
    ),
    "prints": Planted(
        a_backend(text=printing),
        "nothing is printed",
        "a request prints 'Thinking...\\nThinking...\\nThinking...\\n' on standard output.",
        "Results go there",
    ),
    "seeds everybody's generator": Planted(
        a_backend(text=seeding),
        "chance comes from the request",
        "a request draws from the global generator of random or numpy, or seeds it.",
        "request.seed",
    ),
    "draws from everybody's generator": Planted(
        a_backend(text=drawing),
        "chance comes from the request",
        "a request draws from the global generator of random or numpy, or seeds it.",
        "random.Random of your own",
    ),
    "closed only once": Planted(
        a_backend(__init__=lambda self: setattr(self, "connection", 1), close=closing_once),
        "nothing is raised",
        "Backend.closing_once raised AttributeError: 'Backend' object has no attribute 'connection' (…).",
        "ends a run",
    ),
}
