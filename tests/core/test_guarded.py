"""A plugin's mistake is told as its own: whose method it was, what it did, and where."""

import pytest
from line_world import FINISH, Detour, Line, go, line_registry, reply

from llm3 import LLM3Error, Prompt, solve
from llm3.errors import BackendError, PluginError, UsageError
from llm3.guarded import guarded
from llm3.testing import ScriptedLLM
from llm3.types import GoalStatus, State


def run(env):
    registry = line_registry()
    return solve(
        env,
        backend=ScriptedLLM([reply(go(FINISH))]),
        planner=Detour(),
        feedback=registry.feedback("categorized"),
        prompt=Prompt(registry.strategy("backtrack")),
    )


def complaint(env):
    with pytest.raises(PluginError) as caught:
        run(env)
    return str(caught.value)


@pytest.mark.parametrize(
    ("method", "answer", "sentence"),
    [
        ("reset", None, "Faulty.reset must answer State, not NoneType."),
        ("describe", None, "Faulty.describe must answer tuple or list, not NoneType."),
        ("describe", ("robot",), "Faulty.describe must answer a tuple of Entity, not of 'robot'."),
        ("prepare", None, "Faulty.prepare must answer MotionProblem or NoMotion or Failure, not NoneType."),
        ("apply", State(), "Faulty.apply must answer Transition, not State."),
        ("goal", True, "Faulty.goal must answer GoalStatus, not bool."),
    ],
)
def test_a_wrong_answer_names_the_method_and_what_it_must_answer(method, answer, sentence):
    Faulty = type("Faulty", (Line,), {method: lambda self, *_: answer})  # a world with one fault
    Faulty.__dict__[method].__name__ = method
    assert complaint(Faulty()) == sentence


@pytest.mark.parametrize("objects", [("coin", "coin"), ("coin", ""), ("coin", "a\nb"), ("coin", 7)])
def test_objects_are_different_names_of_one_line(objects):
    Faulty = type("Faulty", (Line,), {"objects": objects})
    assert complaint(Faulty()) == f"Faulty.objects must be different names of one line, not {objects!r}."


@pytest.mark.parametrize("fault", [KeyError("x"), SystemExit(0)])
def test_an_exception_names_the_method_and_the_place(fault):
    class Faulty(Line):
        def prepare(self, state, action, rng):
            raise fault

    line = Faulty.prepare.__code__.co_firstlineno + 1
    told = f"{type(fault).__name__}: {fault}"
    assert complaint(Faulty()) == f"Faulty.prepare raised {told} (test_guarded.py:{line})."


def test_what_a_noun_refuses_is_told_of_the_plugins_line():
    class Faulty(Line):
        def goal(self, state):
            return GoalStatus(True, ("the robot is late",))

    line = Faulty.goal.__code__.co_firstlineno + 1
    assert complaint(Faulty()) == (
        "Faulty.goal raised ValueError: a goal is either achieved or has unmet parts: name each of them in `unmet` "
        f"(test_guarded.py:{line})."
    )


def test_errors_of_the_framework_and_interrupts_pass_through():
    for passing in (BackendError("no server"), KeyboardInterrupt()):

        class Passing:
            def ask(self):
                raise passing  # noqa: B023  # called at once

        with pytest.raises(type(passing)) as caught:
            guarded(Passing().ask, (str,))
        assert caught.value is passing
        assert isinstance(passing, LLM3Error | KeyboardInterrupt)


def test_a_strategy_that_fixes_the_sequence_needs_one():
    registry = line_registry()
    with pytest.raises(UsageError) as caught:
        solve(
            Line(),
            backend=ScriptedLLM([]),
            planner=Detour(),
            feedback=registry.feedback("categorized"),
            prompt=Prompt(registry.strategy("sample-params")),
        )
    assert str(caught.value) == (
        "the strategy's template 'sample-params.j2' needs a skeleton: the given action sequence."
    )
