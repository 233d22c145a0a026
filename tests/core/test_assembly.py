"""From names to a run: defaults, capabilities, and what is said of whatever is not there."""

from dataclasses import dataclass, replace

import pytest
from line_world import FINISH, FullLineDomain, Line, LineDomain, LineInstance, LinePlugin, go, line_registry, reply
from threadpoolctl import threadpool_info, threadpool_limits

from llm3 import Budget, LLMBackend, Registry, hookimpl, prepare
from llm3.assembly import RunConfig, assemble, choose_instance, choose_options, open_problem
from llm3.errors import InstanceError, MissingCapability, PluginError, UnknownName, UsageError
from llm3.jsonio import dumps, loads
from llm3.testing import ScriptedLLM
from llm3.types import Completion, Sketch


def config(**changes):
    return RunConfig(**{"domain": "full-line", **changes})


def complaint(call, *arguments, error=UsageError, **keywords):
    with pytest.raises(error) as caught:
        call(*arguments, **keywords)
    return str(caught.value)


def with_model(run, model):
    return replace(run, solver=replace(run.solver, backend=model))


# ---- what a user asks for ------------------------------------------------------------------------------------------


def test_the_defaults_are_the_papers_and_need_no_network():
    assert RunConfig("boxpack") == RunConfig(
        domain="boxpack",
        setting=None,
        seed=0,
        solver="loop",
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
        max_motion_calls=None,
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
        ({"solver": "serach"}, "unknown solver 'serach'; did you mean 'search'? Known: loop, search."),
        ({"max_motion_calls": 0}, "the number of motion calls must be at least 1, not 0."),
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


class NoRoom(FullLineDomain):
    name = "no-room"

    def make(self, instance, options):
        raise InstanceError("the coin and the wall start in one another")


@pytest.mark.parametrize(("source", "first"), [("my.json", "my.json: "), ("", "")])
def test_where_an_instance_comes_from_is_said_first_if_no_world_can_be_made_of_it(source, first):
    class Plugin:
        @hookimpl
        def llm3_domains(self):
            return {"no-room": NoRoom}

    registry, sentence = line_registry(), f"{first}the coin and the wall start in one another"
    registry.register(Plugin(), "no-room")
    one, asked = LineInstance(0.0), config(domain="no-room")
    assert complaint(open_problem, NoRoom(), one, {}, source=source, error=InstanceError) == sentence
    assert complaint(assemble, registry, asked, one, source=source, error=InstanceError) == sentence
    assert complaint(prepare(registry, asked, one, source).open, error=InstanceError) == sentence


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
        assert run.solver.skeleton == ()
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
            result = with_model(run, model).solve()
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
        assert run.solver.skeleton == skeleton
    with assemble(line_registry(), config(strategy="backtrack")) as run:
        assert run.solver.skeleton == ()


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


# ---- two solvers ---------------------------------------------------------------------------------------------------


def test_a_search_needs_no_model_no_prompt_and_no_feedback():
    registry = Registry()
    registry.register(LinePlugin(), "line")
    with assemble(registry, config(solver="search"), LineInstance(0.0)) as run:
        assert (run.solver.language_model, run.solver.last_words) == (False, "")
        assert run.solver.notice == "No language model is used: a search tries actions with parameters drawn at random."
        assert run.solver.regions == {("go", (), "x"): (8.5, 9.5)}
        assert run.config.llm is None
        assert run.config.max_motion_calls == 2000
        assert run.config.run_name == "full-line/instance/0/search"
        result = replace(run, config=replace(run.config, max_motion_calls=7)).solve()
    assert (result.stop, result.stats.motion_calls, result.stats.llm_calls) == ("motions", 7, 0)


def test_a_limit_in_motion_calls_or_seconds_is_left_as_it_is():
    for limits in ({"max_motion_calls": 5}, {"max_seconds": 1.5}, {"max_motion_calls": 5, "max_seconds": 1.5}):
        with prepare(line_registry(), config(solver="search", **limits)) as prepared:
            assert prepared.config.budget == Budget(**limits)
    with prepare(line_registry(), config()) as prepared:
        assert prepared.config.max_motion_calls is None


@pytest.mark.parametrize(
    ("name", "value"),
    [("llm", "random"), ("model", "m"), ("temperature", 0.0), ("max_reply_tokens", 9), ("max_tokens_total", 9)],
)
def test_what_belongs_to_a_model_is_refused_by_a_search(name, value):
    sentence = f"the solver 'search' asks no model: leave out --{name.replace('_', '-')}."
    assert complaint(config, solver="search", **{name: value}) == sentence


def test_the_loop_takes_a_limit_of_motion_calls_as_well():
    model = ScriptedLLM(lambda request: reply(go(len(request.context.trace) + 1)))
    with assemble(line_registry(), config(max_motion_calls=3), LineInstance(0.0)) as run:
        result = with_model(run, model).solve()
    assert (result.stop, result.stats.motion_calls, result.stats.llm_calls) == ("motions", 3, 3)


# ---- prepared, opened, remade --------------------------------------------------------------------------------------


def test_what_is_prepared_has_no_world_yet_and_says_what_it_will_use():
    made = []

    class Watched(FullLineDomain):
        def make(self, instance, options):
            made.append(instance)
            return super().make(instance, options)

    with prepare(registry_with(Watched), config(options={"ground": "wet"})) as prepared:
        assert made == []
        assert prepared.config == config(setting="far", llm="offline", timing="none", options={"ground": "wet"})
        assert (prepared.language_model, prepared.instance) == (False, LineInstance(0.0))
        assert prepared.notice.startswith("No language model is used")
        assert prepared.options == {"ground": "wet", "colour": "red"}
        with prepared.open() as run:
            assert made == [LineInstance(0.0)]
            assert run.solve().solved


def test_the_plugins_of_a_run_are_named_with_where_they_come_from():
    with prepare(line_registry(), config(strategy="scratch", feedback="none", llm="random")) as prepared:
        assert prepared.plugins == {
            "domain/full-line": "line (test)",
            "planner/birrt": "line (test)",
            "strategy/scratch": "templates (test)",
            "feedback/none": "line (test)",
            "backend/random": "standins (test)",
        }
    with prepare(line_registry(), config(solver="search")) as prepared:
        assert set(prepared.plugins) == {"domain/full-line", "planner/birrt"}


class Second(Line):
    """A world that was made of another one."""


class Thrifty(FullLineDomain):
    """Makes one world out of another, unless told not to."""

    def remake(self, env, instance, options):
        if instance.start == 13 / 2:
            raise ZeroDivisionError("no way")
        return None if options["ground"] == "wet" else Second(start=instance.start)


def registry_with(domain):
    class Plugin(LinePlugin):
        @hookimpl
        def llm3_domains(self):
            return {"full-line": domain}

    registry = Registry()
    registry.register(Plugin(), "other line")
    import llm3_standins.plugin
    import llm3_templates.plugin

    registry.register(llm3_templates.plugin, "templates")
    registry.register(llm3_standins.plugin, "standins")
    return registry


def test_a_run_gives_its_world_away_and_the_next_one_is_made_of_it():
    registry = registry_with(Thrifty)
    with assemble(registry, config()) as run:
        spare = run.release()
    assert spare.closed == 0
    with prepare(registry, config(seed=1)).open(spare=spare) as run:
        assert type(run.problem.env) is Second
        assert run.solve().solved
    assert spare.closed == 0
    assert run.problem.env.closed == 1


@pytest.mark.parametrize(
    ("domain", "changes"),
    [(FullLineDomain, {}), (Thrifty, {"options": {"ground": "wet"}})],
    ids=["no such capability", "not for this one"],
)
def test_a_spare_world_that_is_of_no_use_is_closed_and_a_new_one_made(domain, changes):
    spare = Line()
    with prepare(registry_with(domain), config(**changes)).open(spare) as run:
        assert spare.closed == 1
        assert type(run.problem.env) is Line
        assert run.solve().solved


def test_a_spare_world_is_closed_as_well_when_the_next_one_cannot_be_made():
    spare = Line()
    prepared = prepare(registry_with(Thrifty), config(), LineInstance(13 / 2))
    text = complaint(prepared.open, spare=spare, error=PluginError)
    assert text.startswith("Thrifty.remake raised ZeroDivisionError: no way (test_assembly.py:")
    assert spare.closed == 1


def test_an_instance_that_cannot_be_written_is_the_domains_mistake():
    @dataclass(frozen=True)
    class Odd:
        value: complex = 1j

    class OddDomain(LineDomain):
        name, instance_type = "odd", Odd

        def instance(self, setting, seed):
            return Odd()

    assert complaint(choose_instance, OddDomain(), None, 0, error=PluginError) == (
        "an instance of domain 'odd' cannot be written to a file: complex has no JSON form. "
        "Its fields are dataclasses, tuples, dicts, texts and numbers."
    )
