"""Plugins enter by one door: what they bring, who brought it, and what failed to load."""

import sys
from importlib import metadata

import pytest
from line_world import Detour, Line, LineDomain, LinePlugin, Plain, line_registry

from llm3 import Domain, LLMBackend, PlannerSettings, Registry, Strategy, hookimpl, hookspecs
from llm3.errors import PluginError, UnknownName
from llm3.interfaces import BackendSettings, ModelSource
from llm3.registry import HOOKS, BrokenPlugin

ALL_HOOKS = (
    "llm3_backends, llm3_domains, llm3_experiments, llm3_feedback, llm3_model_sources, llm3_planners, "
    "llm3_strategies, llm3_timers"
)

BRINGS_A_DOMAIN = """
from llm3 import hookimpl

@hookimpl
def llm3_domains():
    return {"corridor": dict, "kitchen": dict}
"""
BRINGS_A_PLANNER = """
from llm3 import hookimpl

@hookimpl
def llm3_planners():
    return {"straight": list}
"""


@pytest.fixture
def plugin(tmp_path, monkeypatch):
    """Makes an entry point for a module with this text."""
    monkeypatch.syspath_prepend(tmp_path)
    before = set(sys.modules)

    def make(name, text):
        (tmp_path / f"scratch_{name}.py").write_text(text, encoding="utf-8")
        return metadata.EntryPoint(name, f"scratch_{name}", "llm3")

    yield make
    for module in set(sys.modules) - before:
        if module.startswith("scratch_"):
            del sys.modules[module]


@pytest.fixture
def distribution(tmp_path):
    """Makes the entry points of an installed distribution."""

    def make(name, version, points):
        folder = tmp_path / f"{name.replace('-', '_')}-{version}.dist-info"
        folder.mkdir()
        (folder / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n", encoding="utf-8")
        lines = "".join(f"{point} = {module}\n" for point, module in points.items())
        (folder / "entry_points.txt").write_text(f"[llm3]\n{lines}", encoding="utf-8")
        return list(metadata.PathDistribution(folder).entry_points)

    return make


def complaint(call, *arguments, error=PluginError):
    with pytest.raises(error) as caught:
        call(*arguments)
    assert "\n" not in str(caught.value)
    return str(caught.value)


# ---- what is there -------------------------------------------------------------------------------------------------


def test_every_kind_is_found_by_its_name():
    registry = line_registry()
    assert registry.domain("line").name == "line"
    assert registry.strategy("backtrack").template == "backtrack.j2"
    assert isinstance(registry.planner("birrt"), Detour)
    assert isinstance(registry.feedback("categorized"), Plain)
    assert not registry.backend("random", BackendSettings(skeleton=(1,))).is_language_model


def test_names_are_sorted_and_come_with_who_brought_them():
    registry = line_registry()
    assert registry.names("domain") == ("full-line", "line")
    assert registry.names("strategy") == ("backtrack", "sample-params", "scratch")
    assert [(r.kind, r.name, r.plugin) for r in registry.registrations("planner")] == [
        ("planner", "birrt", "line (test)")
    ]
    assert set(HOOKS) == {
        "domain",
        "strategy",
        "feedback",
        "planner",
        "timer",
        "backend",
        "model source",
        "experiment",
    }


def test_every_hook_is_documented_and_brings_a_kind():
    hooks = {name: hook for name, hook in vars(hookspecs).items() if name.startswith("llm3_")}
    assert set(hooks) == set(HOOKS.values())
    assert all(hook.__doc__ for hook in hooks.values())


def test_two_registries_know_nothing_of_each_other():
    line_registry()
    assert Registry().names("domain") == ()


def test_factories_are_called_only_when_their_name_is_asked_for_and_each_time():
    made = []

    class Lazy:
        @hookimpl
        def llm3_planners(self):
            return {"lazy": lambda settings: made.append(settings) or Detour()}

    registry = Registry()
    registry.register(Lazy(), "lazy")
    assert made == []
    settings = PlannerSettings(max_iterations=7)
    assert registry.planner("lazy", settings) is not registry.planner("lazy")
    assert made == [settings, PlannerSettings()]


# ---- finding plugins -----------------------------------------------------------------------------------------------


def test_plugins_are_found_by_their_entry_points(plugin):
    registry = Registry.discover([plugin("world", BRINGS_A_DOMAIN), plugin("mover", BRINGS_A_PLANNER)])
    assert registry.names("domain") == ("corridor", "kitchen")
    assert registry.names("planner") == ("straight",)
    assert registry.broken == ()


def test_an_installed_plugin_is_named_with_its_distribution(plugin, distribution):
    plugin("world", BRINGS_A_DOMAIN)
    registry = Registry.discover(distribution("llm3-worlds", "2.1", {"world": "scratch_world"}))
    assert {r.plugin for r in registry.registrations("domain")} == {"world (llm3-worlds 2.1)"}


def test_what_ships_with_llm3_comes_first_so_that_a_stranger_cannot_take_its_names(plugin, distribution):
    plugin("world", BRINGS_A_DOMAIN)
    plugin("other", BRINGS_A_DOMAIN)
    points = distribution("aardvark", "1.0", {"other": "scratch_other"})
    registry = Registry.discover(points + distribution("llm3", "0.1", {"world": "scratch_world"}))
    assert {r.plugin for r in registry.registrations("domain")} == {"world (llm3 0.1)"}
    assert registry.broken == (
        BrokenPlugin(
            "other (aardvark 1.0)",
            "domain 'corridor' is registered by world (llm3 0.1) and by other (aardvark 1.0).",
        ),
    )


def test_the_order_of_entry_points_does_not_matter(plugin):
    points = [plugin("world", BRINGS_A_DOMAIN), plugin("copy", BRINGS_A_DOMAIN), plugin("mover", BRINGS_A_PLANNER)]
    one, other = Registry.discover(points), Registry.discover(reversed(points))
    assert one.registrations("domain") == other.registrations("domain")
    assert one.broken == other.broken


def test_without_any_entry_point_a_line_says_how_to_install():
    assert complaint(Registry.discover, []) == (
        "llm3 is not installed, so it has no plugins: run 'pip install .' in its checkout."
    )


BROKEN = {
    "an import that fails": (
        "import no_such_package",
        "ModuleNotFoundError: No module named 'no_such_package' (scratch_bad.py:1)",
    ),
    "an import that raises anything": ("raise RuntimeError('bad\\nday')", "RuntimeError: bad day (scratch_bad.py:1)"),
    "an import that ends the program": ("import sys; sys.exit('bye')", "SystemExit: bye (scratch_bad.py:1)"),
    "a syntax error": ("def", "SyntaxError: invalid syntax (scratch_bad.py, line 1)"),
    "a misspelt hook": (
        "from llm3 import hookimpl\n@hookimpl\ndef llm3_domain(): return {}",
        f"plugin bad implements an unknown hook, 'llm3_domain'. Hooks: {ALL_HOOKS}.",
    ),
    "no hook": (
        "def llm3_domains(): return {}",
        f"plugin bad implements no hook; mark a function with @hookimpl. Hooks: {ALL_HOOKS}.",
    ),
    "a hook with an argument": (
        "from llm3 import hookimpl\n@hookimpl\ndef llm3_domains(registry): return {}",
        None,
    ),
    "a hook that returns nothing": (
        "from llm3 import hookimpl\n@hookimpl\ndef llm3_domains(): pass",
        "plugin bad: llm3_domains must return a dict of factories by name, not None.",
    ),
    "a hook that returns a list": (
        "from llm3 import hookimpl\n@hookimpl\ndef llm3_domains(): return ['corridor']",
        "plugin bad: llm3_domains must return a dict of factories by name, not ['corridor'].",
    ),
    "a factory that cannot be called": (
        "from llm3 import hookimpl\n@hookimpl\ndef llm3_domains(): return {'corridor': 1}",
        "plugin bad: llm3_domains must return a dict of factories by name, not {'corridor': 1}.",
    ),
    "a name that is no text": (
        "from llm3 import hookimpl\n@hookimpl\ndef llm3_domains(): return {1: list}",
        "plugin bad: llm3_domains must return a dict of factories by name, not {1: <class 'list'>}.",
    ),
    "a hook that fails": (
        "from llm3 import hookimpl\n@hookimpl\ndef llm3_domains(): return 1 / 0",
        "ZeroDivisionError: division by zero (scratch_bad.py:3)",
    ),
    "a name that is taken": (
        BRINGS_A_PLANNER + "@hookimpl\ndef llm3_domains(): return {'kitchen': list}",
        "domain 'kitchen' is registered by a_world and by bad.",
    ),
}


@pytest.mark.parametrize(("text", "reason"), BROKEN.values(), ids=BROKEN)
def test_a_plugin_that_fails_is_remembered_with_the_reason_and_the_rest_goes_on(plugin, text, reason):
    points = [plugin("a_world", BRINGS_A_DOMAIN), plugin("bad", text), plugin("mover", BRINGS_A_PLANNER)]
    registry = Registry.discover(points)
    (broken,) = registry.broken
    assert broken.plugin == "bad"
    assert reason in (None, broken.reason)
    assert "\n" not in broken.reason
    assert registry.names("domain") == ("corridor", "kitchen")
    assert registry.names("planner") == ("straight",)


def test_a_hook_with_an_argument_is_told_what_does_not_fit(plugin):
    text = BROKEN["a hook with an argument"][0]
    (broken,) = Registry.discover([plugin("bad", text)]).broken
    assert broken.reason.startswith("plugin bad does not fit the hooks: Plugin 'bad' for hook 'llm3_domains'")
    assert "{'registry'}" in broken.reason


def test_an_entry_point_of_what_is_not_there_is_remembered():
    point = metadata.EntryPoint("ghost", "no_such_module", "llm3")
    registry = Registry.discover([point])
    assert registry.broken == (BrokenPlugin("ghost", "ModuleNotFoundError: No module named 'no_such_module'"),)


# ---- registering by hand -------------------------------------------------------------------------------------------


def test_a_plugin_may_be_an_object_and_is_refused_whole_if_a_name_is_taken():
    class Greedy:
        @hookimpl
        def llm3_planners(self):
            return {"mine": Detour}

        @hookimpl
        def llm3_domains(self):
            return {"line": Line}

    registry = line_registry()
    assert complaint(registry.register, Greedy(), "greedy") == (
        "domain 'line' is registered by line (test) and by greedy."
    )
    assert registry.names("planner") == ("birrt",)


def test_after_a_refusal_the_registry_is_as_it_was():
    class Misspelt:
        @hookimpl
        def llm3_planer(self):
            return {}

    registry = line_registry()
    names = {kind: registry.names(kind) for kind in HOOKS}
    assert complaint(registry.register, Misspelt(), "misspelt") == (
        f"plugin misspelt implements an unknown hook, 'llm3_planer'. Hooks: {ALL_HOOKS}."
    )

    class Good:
        @hookimpl
        def llm3_planners(self):
            return {"good": Detour}

    registry.register(Good(), "misspelt")
    assert registry.names("planner") == ("birrt", "good")
    assert {kind: registry.names(kind) for kind in HOOKS if kind != "planner"} == {
        kind: found for kind, found in names.items() if kind != "planner"
    }


def test_the_same_name_in_two_kinds_is_two_things():
    class Both:
        @hookimpl
        def llm3_planners(self):
            return {"line": lambda settings: Detour()}

    registry = line_registry()
    registry.register(Both(), "both")
    assert isinstance(registry.planner("line"), Detour)
    assert isinstance(registry.domain("line"), Domain)


def test_a_plugin_is_registered_once():
    registry, one = Registry(), LinePlugin()
    registry.register(one, "line")
    assert complaint(registry.register, one, "other") == "plugin other is registered twice."
    assert complaint(registry.register, LinePlugin(), "line") == "plugin line is registered twice."


# ---- asking for what is not there ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kind", "name", "sentence"),
    [
        ("domain", "lin", "unknown domain 'lin'; did you mean 'line'? Known: full-line, line."),
        (
            "strategy",
            "backtrak",
            "unknown strategy 'backtrak'; did you mean 'backtrack'? Known: backtrack, sample-params, scratch.",
        ),
        ("planner", "prm", "unknown planner 'prm'. Known: birrt."),
        ("feedback", "no", "unknown feedback 'no'; did you mean 'none'? Known: categorized, none."),
        ("backend", "http", "unknown backend 'http'. Known: offline, random, scripted."),
        ("backend", "", "unknown backend ''. Known: offline, random, scripted."),
    ],
)
def test_an_unknown_name_is_answered_with_close_matches_and_the_known_names(kind, name, sentence):
    assert complaint(getattr(line_registry(), kind), name, error=UnknownName) == sentence


def test_and_with_the_plugins_that_failed_to_load(plugin):
    registry = Registry.discover([plugin("arm", "import no_such_simulator"), plugin("world", BRINGS_A_DOMAIN)])
    reason = "ModuleNotFoundError: No module named 'no_such_simulator' (scratch_arm.py:1)"
    assert complaint(registry.domain, "leg", error=UnknownName) == (
        f"unknown domain 'leg'. Known: corridor, kitchen. Failed to load: arm ({reason})."
    )
    assert complaint(registry.domain, "arm") == f"plugin arm cannot be loaded: {reason}."


@pytest.mark.parametrize(
    ("kind", "hook", "sentence"),
    [
        ("domain", "llm3_domains", "wrong (test): domain 'thing' made a dict, not a Domain."),
        ("strategy", "llm3_strategies", "wrong (test): strategy 'thing' made a dict, not a Strategy."),
        ("planner", "llm3_planners", "wrong (test): planner 'thing' made a dict, not a MotionPlanner."),
        ("feedback", "llm3_feedback", "wrong (test): feedback 'thing' made a dict, not a FeedbackSynthesizer."),
        ("backend", "llm3_backends", "wrong (test): backend 'thing' made a dict, not a LLMBackend."),
    ],
)
def test_a_factory_that_makes_something_else_is_named(kind, hook, sentence):
    wrong = type("Wrong", (), {hook: hookimpl(lambda self: {"thing": lambda *_: {}})})
    registry = Registry()
    registry.register(wrong(), "wrong (test)")
    assert complaint(getattr(registry, kind), "thing") == sentence


# ---- what is installed ---------------------------------------------------------------------------------------------


def test_what_ships_is_found_and_whole():
    registry = Registry.discover()
    shipped = {kind: {r.name for r in registry.registrations(kind) if "(llm3 " in r.plugin} for kind in HOOKS}
    assert shipped == {
        "domain": {"blocks", "boxpack", "kitchen", "tabletop2d"},
        "strategy": {"backtrack", "scratch", "sample-params"},
        "feedback": {"categorized", "binary", "none"},
        "planner": {"birrt", "ompl-bitstar", "ompl-lbkpiece", "ompl-rrtconnect"},
        "timer": {"toppra"},
        "backend": {"offline", "random", "replay", "scripted", "http", "litellm"},
        "model source": {"http"},
        "experiment": {"blocks", "frontier", "kitchen", "smoke", "table1", "table2", "tabletop2d"},
    }
    assert all(isinstance(registry.strategy(name), Strategy) for name in shipped["strategy"])
    assert isinstance(registry.backend("offline", BackendSettings(stand_in=lambda *_: "")), LLMBackend)


def sources(answer):
    class Shelf:
        @hookimpl
        def llm3_model_sources(self):
            return {"shelf": lambda environment: answer or (ModelSource(environment["NAME"], "/srv", "not needed"),)}

    registry = line_registry()
    registry.register(Shelf(), "shelf")
    return registry


def test_model_sources_are_told_the_environment_and_come_sorted():
    registry = sources(())
    assert [source.name for source in registry.model_sources({"NAME": "z"})] == ["z"]
    two = (ModelSource("b", "/b", "set", ("B",)), ModelSource("a", "/a", "not set", ("A",)))
    assert sources(two).model_sources({}) == (two[1], two[0])
    assert Registry().model_sources({}) == ()


@pytest.mark.parametrize("wrong", ["text", ["b"], ("b",), 3])
def test_model_sources_are_a_tuple_of_them(wrong):
    assert complaint(sources(wrong).model_sources, {}) == (
        f"shelf: model source 'shelf' must answer a tuple of ModelSource, not {wrong!r}."
    )


def test_a_source_that_breaks_is_its_plugins_fault():
    assert complaint(sources(()).model_sources, {}) == ("shelf: model source 'shelf' cannot be made: KeyError: 'NAME'")


def test_a_domain_goes_by_its_own_name():
    class Misnamed:
        @hookimpl
        def llm3_domains(self):
            return {"road": LineDomain}

    registry = Registry()
    registry.register(Misnamed(), "misnamed")
    assert complaint(registry.domain, "road") == (
        "domain 'road' is registered under another name than its own, 'line'."
    )


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"instance_type": None}, "odd: domain 'line' has no attribute 'instance_type'."),
        (
            {"default_setting": "nowhere"},
            "odd: the default setting 'nowhere' of domain 'line' is none of its settings: far, near.",
        ),
    ],
)
def test_a_domain_declares_what_it_must(changes, sentence):
    declared = {k: v for k, v in vars(LineDomain).items() if k not in changes}
    Odd = type("Odd", (Domain,), {**declared, **{k: v for k, v in changes.items() if v is not None}})

    class Plugin:
        @hookimpl
        def llm3_domains(self):
            return {"line": Odd}

    registry = Registry()
    registry.register(Plugin(), "odd")
    assert complaint(registry.domain, "line") == sentence
