"""What an experiment's file may say, and what it stands for."""

from contextlib import suppress
from dataclasses import fields

import pytest
from experiment_files import CORRIDOR, TOML, experiment
from hypothesis import given
from hypothesis import strategies as st

from llm3.errors import InputError, LLM3Error, UsageError
from llm3.experiments import Budgets, experiment_of, overridden, parse_toml
from llm3.jsonio import dumps, loads

NAMES = st.text("abc XYZ.-_", min_size=1, max_size=8).filter(str.strip)


def test_a_file_says_which_methods_are_tried_on_which_problems_with_which_seeds():
    found = experiment_of(parse_toml(TOML, "walks.toml"), "walks.toml")
    assert found == experiment()
    assert [method.name for method in found.methods] == ["random", "one random try"]
    assert [(problem.domain, problem.setting) for problem in found.problems] == [("corridor", "default")]
    assert found.seeds == (0, 1, 2)
    assert len(found) == 6


@given(
    st.lists(NAMES, min_size=1, max_size=4, unique=True),
    st.lists(NAMES, min_size=1, max_size=4, unique=True),
    st.integers(1, 5),
    st.integers(0, 10),
)
def test_every_method_meets_the_same_instances(methods, settings, attempts, first):
    found = experiment(
        methods=[{"name": name, "llm": "random"} for name in methods],
        problems=[{"domain": "corridor", "setting": settings}],
        attempts=attempts,
        first_seed=first,
    )
    jobs = list(found.jobs())
    assert len(jobs) == len(found) == len(methods) * len(settings) * attempts == len({job.key for job in jobs})
    met = {name: [(j.config.setting, j.config.seed) for j in jobs if j.key.method == name] for name in methods}
    assert len({tuple(instances) for instances in met.values()}) == 1
    assert {seed for _, seed in met[methods[0]]} == set(range(first, first + attempts))


@given(
    st.lists(st.sampled_from(["categorized", "binary", "none"]), min_size=1, unique=True),
    st.lists(st.integers(0, 9), min_size=1, unique=True),
)
def test_lists_stand_for_all_combinations(feedback, trace):
    found = experiment(methods=[{"name": "all", "llm": "random", "feedback": feedback, "trace_size": trace}])
    assert len(found.methods) == len(feedback) * len(trace) == len({method.name for method in found.methods})
    assert {method.row for method in found.methods} == {"all"}
    asked = {(method.settings["feedback"], method.settings["trace_size"]) for method in found.methods}
    assert asked == {(f, t) for f in feedback for t in trace}


def test_the_name_of_a_method_says_what_tells_it_from_the_others_of_its_row():
    two = experiment(methods=[{"name": "LLM3", "model": ["a/x", "b/y"], "trace_size": [5]}])
    assert [method.name for method in two.methods] == ["LLM3 (a/x)", "LLM3 (b/y)"]


def test_what_all_methods_have_in_common_stands_in_run():
    found = experiment(
        run={"max_llm_calls": 7, "trace_size": 2}, methods=[{"name": "a"}, {"name": "b", "trace_size": 1}]
    )
    configs = [found.config(method, found.problems[0], 0) for method in found.methods]
    assert [(config.max_llm_calls, config.trace_size) for config in configs] == [(7, 2), (7, 1)]


def test_a_model_is_not_for_methods_that_have_a_backend_or_a_solver_of_their_own():
    found = experiment(
        run={"model": "gpt", "temperature": 0.5},
        methods=[{"name": "model"}, {"name": "random", "llm": "random"}, {"name": "search", "solver": "search"}],
    )
    configs = [found.config(method, found.problems[0], 0) for method in found.methods]
    assert [(config.model, config.temperature) for config in configs] == [("gpt", 0.5), (None, None), (None, None)]


def test_plans_of_an_experiment_have_no_times_unless_it_asks_for_them():
    assert {job.config.timing for job in experiment().jobs()} == {"none"}
    assert {job.config.timing for job in experiment(run={"timing": "toppra"}).jobs()} == {"toppra"}


def test_problems_of_one_domain_are_called_by_their_setting():
    found = experiment(problems=[{"domain": "corridor", "setting": ["a", "b"]}])
    assert [problem.name for problem in found.problems] == ["a", "b"]
    found = experiment(problems=[{"domain": "corridor", "setting": "a"}, {"domain": "boxpack", "setting": "a"}])
    assert [problem.name for problem in found.problems] == ["corridor/a", "boxpack/a"]
    found = experiment(problems=[{"domain": "corridor", "setting": "a", "name": "wide"}])
    assert [problem.name for problem in found.problems] == ["wide"]


WHOLE = st.lists(st.integers(-3, 30), max_size=5)


@given(st.sampled_from([field.name for field in fields(Budgets)]), WHOLE)
def test_budgets_are_whole_numbers_from_1_on_that_grow(measure, amounts):
    if sorted({*amounts, 0}) == [0, *amounts]:
        found = experiment(budgets={measure: amounts}).budgets
        assert getattr(found, measure) == tuple(amounts)
        assert found.by_measure == ({measure: tuple(amounts)} if amounts else {})
    else:
        with pytest.raises(InputError) as caught:
            experiment(budgets={measure: amounts})
        assert str(caught.value) == (
            f"walks.toml: the budgets of {measure} must be whole numbers from 1 on, each larger than the one before, "
            f"not {amounts} - at `$.budgets`"
        )


def test_budgets_change_no_run():
    asked = experiment(budgets={"tokens": [2000], "llm_calls": [1, 5]})
    assert asked.budgets == Budgets(llm_calls=(1, 5), tokens=(2000,))
    assert list(asked.budgets.by_measure) == ["llm_calls", "tokens"]
    assert list(asked.jobs()) == list(experiment().jobs())
    assert asked.only(("random",)).budgets == Budgets()


def test_an_experiment_survives_its_way_to_json_and_back():
    made = experiment(
        layouts=[
            {
                "title": "T",
                "measures": ["success"],
                "groups": [{"title": "", "columns": [{"title": "c", "problem": "default"}]}],
            }
        ],
        published=[{"source": "s", "measures": ["success"], "figures": {"random": {"default": [50]}}}],
        budgets={"motion_calls": [10, 20], "seconds": [60]},
    )
    assert loads(dumps(made), type(made), "") == made


WRONG = {
    "no method": ({"methods": []}, "walks.toml: an experiment needs at least one method"),
    "no problem": ({"problems": []}, "walks.toml: an experiment needs at least one problem"),
    "no attempt": ({"attempts": 0}, "walks.toml: attempts must be from 1 to 100000, not 0"),
    "a negative seed": ({"first_seed": -1}, "walks.toml: first_seed must be from 0 to 9223372036854675807, not -1"),
    "attempts as text": ({"attempts": "ten"}, 'walks.toml: Expected `int`, got `str` "ten" - at `$.attempts`'),
    "no name": ({"methods": [{"llm": "random"}]}, "walks.toml: method 1 needs a name"),
    "a name twice": ({"methods": [{"name": "a"}, {"name": "a"}]}, "walks.toml: the method 'a' is there twice"),
    "an empty list": ({"methods": [{"name": "a", "model": []}]}, "walks.toml: method 'a' has an empty list of model"),
    "a measure that is none": (
        {"layouts": [{"title": "", "measures": ["speed"], "groups": []}]},
        "walks.toml: unknown measure 'speed': success, llm_calls, motion_calls, motion_calls_with_reused, iterations, "
        "tokens, seconds - at `$.layouts[0]`",
    ),
    "figures that do not fit": (
        {"published": [{"source": "", "measures": ["success"], "figures": {"random": {"default": [1, 2]}}}]},
        "walks.toml: the figures of 'random' on 'default' must be 1 numbers, success, not 2 - at `$.published[0]`",
    ),
    "budgets of nothing known": (
        {"budgets": {"speed": [1]}},
        "walks.toml: unknown field `speed`, expected llm_calls, motion_calls, tokens, seconds - at `$.budgets`",
    ),
    "budgets that shrink": (
        {"budgets": {"llm_calls": [5, 2]}},
        "walks.toml: the budgets of llm_calls must be whole numbers from 1 on, each larger than the one before, "
        "not [5, 2] - at `$.budgets`",
    ),
    "a budget that is there twice": (
        {"budgets": {"tokens": [2, 2]}},
        "walks.toml: the budgets of tokens must be whole numbers from 1 on, each larger than the one before, "
        "not [2, 2] - at `$.budgets`",
    ),
    "half a call": (
        {"budgets": {"motion_calls": [1.5]}},
        "walks.toml: Expected `int`, got `float` 1.5 - at `$.budgets.motion_calls[0]`",
    ),
    "a budget without a list": (
        {"budgets": {"motion_calls": 10}},
        "walks.toml: Expected `array`, got `int` 10 - at `$.budgets.motion_calls`",
    ),
    "budgets that are a list": (
        {"budgets": [1, 2]},
        "walks.toml: Expected `object`, got `array` - at `$.budgets`",
    ),
    "a budget without end": (
        {"budgets": {"seconds": [1, float("inf")]}},
        "walks.toml: budgets.seconds.1 must be a finite number, not inf",
    ),
    "a number without end": (
        {"run": {"max_seconds": float("inf")}},
        "walks.toml: run.max_seconds must be a finite number, not inf",
    ),
    "a budget of nothing": (
        {"methods": [{"name": "a", "max_llm_calls": 0}]},
        "walks.toml: the number of model calls must be at least 1, not 0.",
    ),
    "a name that is a path": (
        {"name": "../walks"},
        "walks.toml: the name of an experiment is made of letters, digits and _.-, not '../walks'",
    ),
    "a name that cannot be printed": (
        {"methods": [{"name": "a\x1b"}]},
        "walks.toml: the name of a method is a printable text of 1 to 200 characters, not 'a\\x1b'",
    ),
    "a seed beyond all": (
        {"first_seed": 2**63},
        "walks.toml: first_seed must be from 0 to 9223372036854675807, not 9223372036854775808",
    ),
    "a column of nothing": (
        {
            "layouts": [
                {
                    "title": "T",
                    "measures": ["success"],
                    "groups": [{"title": "", "columns": [{"title": "", "problem": "x"}]}],
                }
            ]
        },
        "walks.toml: layout 'T' has a column of 'x', which is none of the problems: default",
    ),
    "a layout without measures": (
        {"layouts": [{"title": "T", "measures": [], "groups": []}]},
        "walks.toml: the layout 'T' needs at least one measure - at `$.layouts[0]`",
    ),
    "a layout without groups": (
        {"layouts": [{"title": "T", "measures": ["success"], "groups": []}]},
        "walks.toml: the layout 'T' needs at least one group - at `$.layouts[0]`",
    ),
    "an option that is neither text nor number": (
        {"problems": [{"domain": "corridor", "setting": "default", "options": {"walls": True}}]},
        "walks.toml: Expected `int | float | str`, got `bool` true - at `$.problems[0].options.walls`",
    ),
    "a value of another type": (
        {"methods": [{"name": "a", "trace_size": "five"}]},
        "walks.toml: method 'a': Expected `int`, got `str` \"five\" - at `$.trace_size`",
    ),
}


@pytest.mark.parametrize(("changes", "sentence"), WRONG.values(), ids=WRONG)
def test_what_is_wrong_with_a_file_is_told_in_a_line(changes, sentence):
    with pytest.raises(InputError) as caught:
        experiment(**changes)
    assert str(caught.value) == sentence


def test_a_field_that_no_run_has_is_told_with_those_that_come_close():
    with pytest.raises(InputError) as caught:
        experiment(methods=[{"name": "a", "max_llm_call": 5}])
    assert str(caught.value).startswith(
        "walks.toml: unknown field 'max_llm_call' of method 'a'; did you mean 'max_llm_calls'"
    )
    with pytest.raises(InputError) as caught:
        experiment(run={"seed": 5})
    assert str(caught.value).startswith("walks.toml: unknown field 'seed' of [run]. Known: feedback, llm, ")


def test_what_is_no_toml_is_told_with_its_place():
    with pytest.raises(InputError) as caught:
        parse_toml("name = ", "walks.toml")
    assert str(caught.value).startswith("walks.toml: no TOML: Invalid value (at ")


@given(
    st.recursive(
        st.none() | st.booleans() | st.integers() | st.text(max_size=5),
        lambda v: (
            st.lists(v, max_size=3)
            | st.dictionaries(st.sampled_from([*CORRIDOR, "run", "llm", "budgets", "tokens"]), v, max_size=4)
        ),
        max_leaves=12,
    )
)
def test_no_file_can_do_more_harm_than_an_error(value):
    if isinstance(value, dict):
        with suppress(LLM3Error):
            experiment_of({**CORRIDOR, **value}, "walks.toml")


def test_numbers_among_the_options_of_a_domain_need_no_quotes():
    options = {"walls": 0.05, "seats": 3, "robot": "iiwa"}
    made = experiment(problems=[{"domain": "corridor", "setting": "default", "options": options}])
    assert made.problems[0].options == {"walls": "0.05", "seats": "3", "robot": "iiwa"}


WRONG_FIELDS = {
    "methods.radnom.llm": "unknown method 'radnom'; did you mean 'random'? Known: one random try, random.",
    "title.x": "--set 'title.x': 'title' is a value and has no fields.",
    "run.": "--set 'run.': a field is a name, or several with a dot between them.",
    "run..x": "--set 'run..x': a field is a name, or several with a dot between them.",
}


class TestFieldsOnTheCommandLine:
    """`--set FIELD=VALUE`."""

    @pytest.mark.parametrize(
        ("field", "value", "expected"),
        [
            ("attempts", "7", 7),
            ("title", "a title", "a title"),
            ("title", '"7"', "7"),
            ("run.max_llm_calls", "3", 3),
            ("run.model", '["a", "b"]', ["a", "b"]),
            ("run.model", "openai/gpt-4.1", "openai/gpt-4.1"),
            ("methods.random.trace_size", "1", 1),
            ("methods.one random try.trace_size", "1", 1),
            ("budgets.llm_calls", "[1, 5]", [1, 5]),
            ("problems.default.options.walls", '"0.05"', "0.05"),
        ],
    )
    def test_any_field_can_be_set(self, field, value, expected):
        changed = overridden(CORRIDOR, [(field, value)])
        first, *path = field.split(".")
        found = changed[first]
        if first in ("methods", "problems"):
            found = next(entry for entry in found if path[0] in (entry.get("name"), entry.get("setting")))
            path = path[1:]
        for name in path:
            found = found[name]
        assert found == expected

    def test_a_problem_with_several_settings_goes_by_the_name_of_its_domain(self):
        several = {"domain": "boxpack", "setting": ["dense-6", "dense-8"]}
        one = {"domain": "blocks", "setting": "blocks-8"}
        changed = overridden({"problems": [one, several]}, [("problems.boxpack.options.walls", "0.03")])
        assert changed["problems"] == [one, {**several, "options": {"walls": 0.03}}]
        with pytest.raises(LLM3Error) as caught:
            overridden({"problems": [one, several]}, [("problems.boxpack/dense-6.name", "x")])
        assert (
            str(caught.value) == "unknown problem 'boxpack/dense-6'; did you mean 'boxpack'? Known: blocks-8, boxpack."
        )

    def test_the_file_itself_is_left_as_it_is(self):
        before = dumps(CORRIDOR)
        overridden(CORRIDOR, [("methods.random.trace_size", "1"), ("run.model", "x")])
        assert dumps(CORRIDOR) == before

    def test_of_two_names_of_which_one_begins_the_other_the_longer_is_meant(self):
        written = {"methods": [{"name": "a"}, {"name": "a.b"}]}
        assert overridden(written, [("methods.a.b.trace_size", "1")])["methods"] == [
            {"name": "a"},
            {"name": "a.b", "trace_size": 1},
        ]

    @pytest.mark.parametrize(("field", "sentence"), WRONG_FIELDS.items(), ids=WRONG_FIELDS)
    def test_a_field_that_cannot_be_set_is_told_in_a_line(self, field, sentence):
        with pytest.raises(UsageError) as caught:
            overridden(CORRIDOR, [(field, "1")])
        assert str(caught.value) == sentence
