"""The fake model for tests: it says what it is told to say."""

import numpy as np
import pytest
from line_world import Line

from llm3.errors import BackendError
from llm3.testing import ScriptedLLM, stand_in_script
from llm3.types import Completion, Context, Message, Request, Stats

ENV = Line()
CONTEXT = Context(ENV.task, ENV.schemas, ENV.objects, ENV.describe(ENV.reset()))
REQUEST = Request((Message("system", "You plan."), Message("user", "Plan!")), CONTEXT, seed=3)


def generated():
    yield "one"
    yield "two"


@pytest.mark.parametrize(
    "script",
    [["one", "two"], ("one", "two"), generated, lambda: [Completion("one"), "two"]],
    ids=["a list", "a tuple", "a generator", "completions"],
)
def test_replies_come_in_order(script):
    model = ScriptedLLM(script() if callable(script) else script)
    assert [model.complete(REQUEST).text, model.complete(REQUEST).text] == ["one", "two"]


def test_a_function_answers_the_request():
    model = ScriptedLLM(lambda request: f"seed {request.seed}")
    assert model.complete(REQUEST) == Completion("seed 3")
    assert model.complete(REQUEST) == Completion("seed 3")


def test_a_stand_in_answers_from_the_context_and_the_seed():
    model = ScriptedLLM(stand_in_script(lambda context, rng: f"{context.task} {rng.integers(1000)}"))
    said = f"{ENV.task} {np.random.default_rng(3).integers(1000)}"
    assert [model.complete(REQUEST).text for _ in range(2)] == [said, said]


def test_a_completion_is_handed_on_as_it_is():
    completion = Completion("one", Stats(prompt_tokens=4), model="toy")
    assert ScriptedLLM([completion]).complete(REQUEST) is completion


@pytest.mark.parametrize("error", [BackendError("no"), ValueError("no"), KeyboardInterrupt()])
def test_an_exception_is_raised_instead(error):
    for script in ([error], lambda _: error):
        with pytest.raises(type(error)):
            ScriptedLLM(script).complete(REQUEST)


@pytest.mark.parametrize(
    ("script", "sentence"),
    [
        ([], "the script has run out after 0 replies."),
        (["one"], "the script has run out after 1 reply."),
        (["one", "two"], "the script has run out after 2 replies."),
    ],
)
def test_running_out_is_an_error(script, sentence):
    model = ScriptedLLM(script)
    for _ in script:
        model.complete(REQUEST)
    with pytest.raises(BackendError) as caught:
        model.complete(REQUEST)
    assert str(caught.value) == sentence


def test_one_text_is_no_script():
    with pytest.raises(TypeError) as caught:
        ScriptedLLM('{"Full Plan": []}')
    assert str(caught.value) == "a script is a list of replies, not one text: write ScriptedLLM([text])"


def test_every_request_is_kept_also_one_that_got_no_answer():
    model = ScriptedLLM(["one"])
    model.complete(REQUEST)
    with pytest.raises(BackendError):
        model.complete(REQUEST)
    assert model.requests == [REQUEST, REQUEST]
    assert model.prompts == ["You plan.\n\nPlan!"] * 2


def test_it_says_that_it_is_no_language_model():
    model = ScriptedLLM([])
    assert not model.is_language_model
    assert model.notice == "No language model is used: the replies come from a script."


def test_half_a_surrogate_pair_in_a_reply_does_no_harm():
    assert ScriptedLLM(["a\ud83db"]).complete(REQUEST).text == "a?b"
