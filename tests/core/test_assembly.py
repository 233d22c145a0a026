"""From names to a run: defaults, capabilities, and what is said of whatever is not there."""

from dataclasses import replace

import pytest
from line_world import FINISH, FullLineDomain, LineDomain, LineInstance, LinePlugin, go, line_registry, reply
from threadpoolctl import threadpool_info, threadpool_limits

from llm3 import LLMBackend, Registry, hookimpl
from llm3.assembly import RunConfig, assemble, choose_instance, choose_options, open_problem
from llm3.errors import MissingCapability, UnknownName, UsageError
from llm3.jsonio import dumps, loads
from llm3.testing import ScriptedLLM
from llm3.types import Completion, Sketch


def config(**changes):
    return RunConfig(**{"domain": "full-line", **changes})


def complaint(call, *arguments, error=UsageError, **keywords):
    with pytest.raises(error) as caught:
        call(*arguments, **keywords)
    return str(caught.value)


# ---- what a user asks for ------------------------------------------------------------------------------------------


def test_the_defaults_are_the_papers_and_need_no_network():
    assert RunConfig("boxpack") == RunConfig(
        domain="boxpack",
        setting=None,
        seed=0,
        strategy="backtrack",
        feedback="categorized",
        llm=None,
        model=None,
        temperature=None,
        planner="birrt",
        planner_iterations=2000,
        planner_seconds=30.0,
        timing=None,
        max_llm_calls=20,
        trace_size=5,
        options={},
    )


def test_a_model_implies_http():
    assert config().backend == "offline"
    assert config(model="gpt-4o").backend == "http"
    assert config(model="gpt-4o", llm="mine:x").backend == "mine:x"
    assert replace(config(), model="gpt-4o").backend == "http"


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"max_llm_calls": 0}, "the number of model calls must be at least 1, not 0."),
        ({"trace_size": -2}, "the trace size must be 0 or more, not -2."),
        ({"model": " "}, "the model's name is empty: name one, or leave out --model."),
        ({"temperature": -1.0}, "the temperature must be 0 or more, not -1."),
        ({"planner_iterations": -1}, "the planner's iterations must be 0 or more, not -1."),
        ({"planner_seconds": 0.0}, "the planner's seconds must be more than 0, not 0."),
    ],
)
def test_what_cannot_be_asked_for(changes, sentence):
    assert complaint(config, **changes) == sentence


def test_a_config_is_json_safe():
    asked = config(setting="near", options={"ground": "wet"}, temperature=0.5, model="m")
    assert loads(dumps(asked), RunConfig, "a config") == asked
    assert hash(asked) == hash(replace(asked))


# ---- instances and options -----------------------------------------------------------------------------------------


def test_an_instance_comes_from_a_setting_and_a_seed():
    domain = LineDomain()
    assert choose_instance(domain, "near", 1) == choose_instance(domain, "near", 1) == LineInstance(6.0)
    assert choose_instance(domain, "near", 2) == LineInstance(7.0)
    assert choose_instance(domain, None, 1) == choose_instance(domain, "far", 1) == LineInstance(1.0)


def test_an_unknown_setting_is_answered_with_the_known_ones():
    assert complaint(choose_instance, LineDomain(), "fra", 0, error=UnknownName) == (
        "unknown setting 'fra' of domain 'line'; did you mean 'far'? Known: far, near."
    )


def test_every_option_has_a_value():
    assert choose_options(LineDomain(), {}) == {"ground": "dry", "colour": "red"}
    assert choose_options(LineDomain(), {"colour": "any text"}) == {"ground": "dry", "colour": "any text"}
    assert list(choose_options(LineDomain(), {"colour": "blue", "ground": "wet"})) == ["ground", "colour"]


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (
            {"gruond": "wet"},
            "unknown option 'gruond' of domain 'line'; did you mean 'ground'? Known: colour, ground.",
        ),
        ({"ground": "icy"}, "unknown value 'icy' of option 'ground'. Known: dry, wet."),
    ],
)
def test_an_unknown_option_or_value_is_answered_with_the_known_ones(options, sentence):
    assert complaint(choose_options, LineDomain(), options, error=UnknownName) == sentence


# ---- worlds --------------------------------------------------------------------------------------------------------


def test_a_world_is_made_from_the_instance_and_the_options_and_closed_after_use():
    with open_problem(LineDomain(), LineInstance(3.0), {"ground": "wet"}) as problem:
        assert problem.env.reset().configuration == (3.0,)
        assert problem.env.slippery == {8.0: 1.0}
        assert problem.options == {"ground": "wet", "colour": "red"}
        assert problem.env.closed == 0
    assert problem.env.closed == 1


def test_a_world_is_closed_also_after_an_error():
    with pytest.raises(ZeroDivisionError), open_problem(LineDomain(), LineInstance(3.0), {}) as problem:
        raise ZeroDivisionError
    assert problem.env.closed == 1


def test_a_window_needs_a_domain_that_has_one():
    assert open_problem(FullLineDomain(), LineInstance(0.0), {}, window=True).env.window
    assert complaint(open_problem, LineDomain(), LineInstance(0.0), {}, window=True, error=MissingCapability) == (
        "domain 'line' has no window, which --gui needs."
    )


# ---- runs ----------------------------------------------------------------------------------------------------------


def test_numpy_works_on_one_thread_during_a_run_and_as_before_after_it():
    def threads():
        return {pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"}

    with threadpool_limits(2, user_api="blas"), assemble(line_registry(), config()) as run:
        before, during = threads(), set()
        run.solve(lambda _event: during.update(threads()))
        assert during == ({1} if before else set())  # numpy may be built without such a library
        assert threads() == before


def test_a_run_is_assembled_and_solved():
    with assemble(line_registry(), config()) as run:
        assert run.config == config(setting="far", llm="offline", timing="none")
        assert run.problem.instance == LineInstance(0.0)
        assert run.skeleton == ()
        result = run.solve()
    assert result.solved
    assert [step.action for step in result.plan] == [go(FINISH)]
    assert run.problem.env.closed == 1


def test_an_instance_may_be_given_and_then_no_setting_is_named():
    with assemble(line_registry(), config(seed=3), LineInstance(7.5)) as run:
        assert run.problem.instance == LineInstance(7.5)
        assert run.config.setting is None


def test_the_budget_the_trace_and_the_seed_are_those_that_were_asked_for():
    model = ScriptedLLM(lambda request: reply(go(1)))
    seeds = []
    for seed in (0, 1):
        with assemble(line_registry(), config(max_llm_calls=4, trace_size=2, seed=seed), LineInstance(0.0)) as run:
            result = replace(run, backend=model).solve()
        seeds.append(model.requests[-1].seed)
        assert result.stats.llm_calls == 4
        assert [feedback.attempt for feedback in model.requests[-1].context.trace] == [2, 3]
    assert seeds[0] != seeds[1]


def test_an_observer_is_passed_on():
    seen = []
    with assemble(line_registry(), config()) as run:
        result = run.solve(seen.append)
    assert seen[-1].result is result


def test_a_strategy_that_fixes_the_sequence_takes_the_domains():
    skeleton = (Sketch("go"), Sketch("take", ("coin",)), Sketch("go"))
    with assemble(line_registry(), config(strategy="sample-params")) as run:
        assert run.skeleton == skeleton
    with assemble(line_registry(), config(strategy="backtrack")) as run:
        assert run.skeleton == ()


def test_and_is_refused_where_the_domain_has_none():
    asked = config(domain="line", strategy="sample-params", llm="scripted:none.json")
    assert complaint(assemble, line_registry(), asked, error=MissingCapability) == (
        "domain 'line' has no skeleton, which strategy 'sample-params' needs."
    )


def test_a_backend_is_told_what_the_user_asked_for_and_what_the_domain_offers():
    told = []

    class Curious(LinePlugin):
        @hookimpl
        def llm3_backends(self):
            return {"http": lambda settings: told.append(settings) or ScriptedLLM([])}

        @hookimpl
        def llm3_strategies(self):
            return {"backtrack": lambda: line_registry().strategy("backtrack")}

    registry = Registry()
    registry.register(Curious(), "curious")
    with assemble(registry, config(llm="http:a:b", model=None, temperature=0.5)):
        pass
    with assemble(registry, config(domain="line", model="m")):
        pass
    full, bare = told
    assert (full.domain, full.argument, full.model, full.temperature) == ("full-line", "a:b", None, 0.5)
    assert full.skeleton == FullLineDomain().skeleton(None)
    assert full.regions == {("go", (), "x"): (8.5, 9.5)}
    assert full.stand_in is not None
    assert (bare.argument, bare.model, bare.temperature) == (None, "m", None)
    assert (bare.skeleton, bare.regions, bare.stand_in) == ((), {}, None)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"domain": "lime"}, "unknown domain 'lime'; did you mean 'line'? Known: full-line, line."),
        ({"setting": "nera"}, "unknown setting 'nera' of domain 'full-line'; did you mean 'near'? Known: far, near."),
        (
            {"strategy": "scrach"},
            "unknown strategy 'scrach'; did you mean 'scratch'? Known: backtrack, sample-params, scratch.",
        ),
        ({"feedback": "binary"}, "unknown feedback 'binary'. Known: categorized, none."),
        ({"planner": "birt"}, "unknown planner 'birt'; did you mean 'birrt'? Known: birrt."),
        ({"llm": "ofline"}, "unknown backend 'ofline'; did you mean 'offline'? Known: offline, random, scripted."),
    ],
)
def test_an_unknown_name_is_answered_before_anything_starts(changes, sentence):
    assert complaint(assemble, line_registry(), config(**changes), error=UnknownName) == sentence


def test_closing_twice_does_no_harm_and_nothing_stays_open_when_the_world_cannot_be_made():
    class Noted(LLMBackend):
        closed = 0

        def complete(self, request):
            return Completion("")

        def close(self):
            self.closed += 1

    backend = Noted()

    class Plugin:
        @hookimpl
        def llm3_backends(self):
            return {"noted": lambda settings: backend}

    registry = line_registry()
    registry.register(Plugin(), "noted")
    with assemble(registry, config(llm="noted")) as run:
        assert backend.closed == 0
    run.close()
    assert backend.closed == 2
    with pytest.raises(UnknownName):
        assemble(registry, config(llm="noted", options={"ground": "icy"}))
    assert backend.closed == 3
