"""What becomes of runs that go wrong, and of those beside them."""

from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import pytest
from experiment_files import Here, carry_out, experiment, lines_of, without_times

from llm3.errors import LLM3Error
from llm3.experiments import read_experiment_folder

HERE = Path("out")
SCRIPTED = {"name": "scripted", "llm": "scripted:replies.json"}
RANDOM = {"name": "random", "llm": "random", "strategy": "sample-params", "feedback": "none"}
FRAGILE = """
from llm3_corridor import Corridor, CorridorEnv
from llm3 import hookimpl


class FragileEnv(CorridorEnv):
    def prepare(self, state, action, rng):
        if self.gap > 0.5:
            raise ZeroDivisionError("the gap is too far left")
        return super().prepare(state, action, rng)


class Fragile(Corridor):
    name = "fragile"

    def make(self, instance, options):
        return FragileEnv(instance)


@hookimpl
def llm3_domains():
    return {"fragile": Fragile}
"""
pytestmark = pytest.mark.usefixtures("plugins")


@pytest.fixture(autouse=True)
def in_an_empty_folder(cwd):
    pass


def test_a_run_that_crashes_is_recorded_and_the_rest_goes_on(install):
    install("llm3_fragile", FRAGILE)
    problems = [{"domain": "fragile", "setting": "default"}]
    lines = carry_out(HERE, experiment(problems=problems, methods=[RANDOM], attempts=8))
    assert [line.key.seed for line in lines] == list(range(8))
    crashed = [line for line in lines if line.status == "crashed"]
    assert {line.status for line in lines} == {"solved", "crashed"}
    for line in crashed:
        assert line.error == (
            "FragileEnv.prepare raised ZeroDivisionError: the gap is too far left (llm3_fragile.py:9)."
        )
        assert "ZeroDivisionError: the gap is too far left" in line.traceback
        assert line.stats.llm_calls == 1  # what it had cost by then


def test_a_server_that_is_gone_ends_the_run_and_a_lasting_silence_the_experiment():
    Path("replies.json").write_text("[]")
    with pytest.raises(LLM3Error) as caught:
        carry_out(HERE, experiment(methods=[SCRIPTED], attempts=30))
    said = str(caught.value)
    assert said.startswith(
        "the last 10 runs of 'scripted' ended with the same error: the script has run out after 0 replies."
    )
    assert [line["status"] for line in lines_of(HERE)] == ["error"] * 10
    assert not any(line["traceback"] for line in lines_of(HERE))


def test_other_methods_between_them_make_the_silence_no_shorter():
    Path("replies.json").write_text("[]")
    with pytest.raises(LLM3Error):
        carry_out(HERE, experiment(methods=[SCRIPTED, RANDOM], attempts=30))
    methods = [line["key"]["method"] for line in lines_of(HERE) if line["status"] == "error"]
    assert methods == ["scripted"] * 10


def test_every_run_that_ended_has_its_line_when_the_experiment_is_ended():
    Path("replies.json").write_text("[]")
    with pytest.raises(LLM3Error):
        carry_out(HERE, experiment(methods=[SCRIPTED], attempts=40), slots=20)
    assert len(lines_of(HERE)) == 20  # which had all ended when the tenth of them was looked at


def test_a_worker_that_dies_takes_its_run_with_it_and_no_other():
    class Deadly(Here):
        def submit(self, fn, /, *args, **kwargs):
            if '"seed":1' in args[0]:
                future = Future()
                future.set_exception(OSError("the worker is gone"))
                return future
            return super().submit(fn, *args, **kwargs)

    lines = carry_out(HERE, experiment(methods=[RANDOM]), Deadly())
    assert [(line.key.seed, line.status, line.error) for line in lines] == [
        (0, "solved", ""),
        (1, "crashed", "OSError: the worker is gone"),
        (2, "solved", ""),
    ]


def test_what_stops_the_experiment_loses_no_line_and_starts_no_run():
    class Stopped(Here):
        def submit(self, fn, /, *args, **kwargs):
            if '"seed":2' in args[0]:
                raise KeyboardInterrupt
            return super().submit(fn, *args, **kwargs)

    with pytest.raises(KeyboardInterrupt):
        carry_out(HERE, experiment(methods=[RANDOM], attempts=5), Stopped())
    assert [line["key"]["seed"] for line in lines_of(HERE)] == [0, 1]
    assert [line.key.seed for line in carry_out(HERE, experiment(methods=[RANDOM], attempts=5))] == [2, 3, 4]


def test_the_lines_are_the_same_however_many_runs_go_on_at_once():
    carry_out(HERE, experiment())
    with ThreadPoolExecutor(3) as pool:
        carry_out(Path("three"), experiment(), pool, slots=3)
    assert without_times(lines_of(HERE)) == without_times(lines_of(Path("three")))


def test_no_more_runs_go_on_at_once_than_a_provider_takes():
    running, most = 0, 0

    class Counting(ThreadPoolExecutor):
        def submit(self, fn, /, *args, **kwargs):
            nonlocal running, most
            running += 1
            most = max(most, running)

            def ended(_):
                nonlocal running
                running -= 1

            future = super().submit(fn, *args, **kwargs)
            future.add_done_callback(ended)
            return future

    with Counting(4) as pool:
        carry_out(HERE, experiment(methods=[RANDOM], attempts=12), pool, slots=4, limits={"random": 2})
    assert most == 2
    assert len(read_experiment_folder(HERE).runs) == 12
