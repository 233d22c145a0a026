"""What a model is sent.

The snapshots in ``snapshots/`` are compared to the last character. After a wanted change of a template, write them
anew and read the difference before it is committed::

    LLM3_WRITE_SNAPSHOTS=1 pytest tests/core/test_prompts.py
"""

import os
import re
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from line_world import Line

from llm3 import Prompt, Strategy
from llm3.errors import PluginError
from llm3.types import ActionSchema, Context, Entity, Feedback, Message, Parameter, Remark, Sketch

SNAPSHOTS = Path(__file__).parent / "snapshots"
SHIPPED = ("backtrack", "scratch", "sample-params")

EMPTY = Context(
    task="A robot packs boxes into a basket.\nThe goal: every box is in the basket.",
    actions=(
        ActionSchema("pick", ("box",), (), "pick up the box from above"),
        ActionSchema(
            "place",
            ("box",),
            (Parameter("x", 0, 1, "m"), Parameter("theta", -3.14, 3.14, "rad"), Parameter("speed", 0.5, 2)),
            "put the held box down",
        ),
        ActionSchema("wait"),
    ),
    objects=("red_box", "blue_box"),
    state=(
        Entity("basket", {"center": (0.65, 0.0), "size": (0.22, 0.21), "floor height": 0.005}),
        Entity("red_box", {"position": (0.39, -0.2, 0.035), "yaw": 0.0, "count": 1}),
        Entity("blue_box", {"position": "in the gripper"}),
        Entity("table"),
    ),
    skeleton=(Sketch("pick", ("red_box",)), Sketch("place", ("red_box",))),
)
FULL = replace(
    EMPTY,
    trace=(
        Feedback(
            2,
            (
                Remark("pick(['red_box'], {})", "feasible"),
                Remark(
                    "place(['red_box'], {'x': 0.5, 'theta': 0.0, 'speed': 1.0})",
                    "failed",
                    "The goal configuration is in collision with basket.",
                ),
                Remark("wait([], {})", "not tried"),
            ),
            "The goal is not reached: red_box is not in the basket.",
        ),
        Feedback(3, summary="No plan could be read from the reply."),
        Feedback(4, (Remark("pick(['red_box'], {})", "feasible", "red_box slid 12 mm."),)),
    ),
)


@cache
def prompt(name):
    return Prompt(Strategy("llm3_templates", f"{name}.j2"))


def text_of(messages):
    return "\n".join(message.content for message in messages)


def shown(messages):
    return "".join(f"--- {message.role} ---\n{message.content}\n" for message in messages)


# ---- the shipped strategies ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("trace", ["empty", "full"])
@pytest.mark.parametrize("name", SHIPPED)
def test_snapshot(name, trace):
    messages = prompt(name).render(EMPTY if trace == "empty" else FULL)
    path = SNAPSHOTS / f"{name}-{trace}.txt"
    if os.environ.get("LLM3_WRITE_SNAPSHOTS"):
        path.write_text(shown(messages), encoding="utf-8")
    assert shown(messages) == path.read_text(encoding="utf-8")


def test_every_snapshot_is_of_a_test():
    assert {path.name for path in SNAPSHOTS.iterdir()} == {f"{n}-{t}.txt" for n in SHIPPED for t in ("empty", "full")}


words = st.text(st.characters(categories=["Ll"]), min_size=1, max_size=8)
figures = st.integers(-999, 999) | st.integers(-9999, 9999).map(lambda n: n / 1000)
ranges = st.tuples(figures, figures).map(sorted)
units = st.sampled_from(["", "m", "rad"])
parameters = st.builds(lambda name, ends, unit: Parameter(name, *ends, unit), words, ranges, units)
schemas = st.builds(
    ActionSchema,
    words,
    st.lists(words, max_size=3).map(tuple),
    st.lists(parameters, max_size=3, unique_by=lambda p: p.name).map(tuple),
    st.just("") | words,
)
entities = st.builds(
    Entity,
    words,
    st.dictionaries(words, figures | words | st.lists(figures, min_size=1, max_size=3).map(tuple), max_size=3),
)
remarks = st.builds(
    Remark, words, st.sampled_from(["feasible", "failed", "not tried"]), st.just("") | words.map("{}.".format)
)
contexts = st.builds(
    Context,
    task=words,
    actions=st.lists(schemas, min_size=1, max_size=3, unique_by=lambda s: s.name).map(tuple),
    objects=st.lists(words, max_size=3, unique=True).map(tuple),
    state=st.lists(entities, min_size=1, max_size=3).map(tuple),
    trace=st.lists(
        st.builds(Feedback, st.integers(1, 20), st.lists(remarks, max_size=3).map(tuple), st.just("") | words),
        max_size=3,
    ).map(tuple),
    skeleton=st.lists(st.builds(Sketch, words, st.lists(words, max_size=2).map(tuple)), min_size=1, max_size=3).map(
        tuple
    ),
)
names = st.sampled_from(SHIPPED)


@given(names, contexts)
def test_nothing_that_the_prompt_is_rendered_from_is_left_out(name, context):
    text = text_of(prompt(name).render(context))
    parts = [context.task, *context.objects]
    for schema in context.actions:
        parts += [schema.name, schema.description, *(f"<{role}>" for role in schema.objects)]
        parts += [f"{p.name} from {p.low} to {p.high}{' ' * bool(p.unit)}{p.unit}" for p in schema.parameters]
    for entity in context.state:
        parts += [entity.name, *entity.properties, *(str(v) for v in entity.properties.values() if isinstance(v, str))]
        parts += [repr(v) for v in entity.properties.values() if isinstance(v, int | float)]
    for feedback in context.trace:
        parts += [f"Attempt {feedback.attempt}:", feedback.summary]
        parts += [f"{i}. {r.action}: {r.verdict}. {r.text}".rstrip() for i, r in enumerate(feedback.remarks, 1)]
    if name == "sample-params":
        parts += [f"{i}. {sketch}" for i, sketch in enumerate(context.skeleton, 1)]
    assert [part for part in parts if part not in text] == []


@given(names, contexts)
def test_no_prompt_has_a_hole(name, context):
    for message in prompt(name).render(context):
        assert message.content == message.content.strip() != ""
        assert not re.search(r"None|Undefined|\{%|%\}|::|;;|,,|[^.]\.\.[^.]|\(\)|[:;,]\.[^.]|\n\n\n", message.content)
        assert not re.search(r"^-? *$^-|^# *$|^\d+\. *$|[ \t]$", message.content, re.MULTILINE)


@given(names, contexts)
def test_the_same_context_gives_the_same_messages(name, context):
    one = prompt(name)
    assert one.render(context) == one.render(context)


@pytest.mark.parametrize("name", SHIPPED)
def test_a_prompt_that_was_loaded_again_writes_the_same(name):
    assert Prompt(Strategy("llm3_templates", f"{name}.j2")).render(FULL) == prompt(name).render(FULL)


@given(names, contexts)
def test_a_prompt_is_a_system_message_and_a_question(name, context):
    assert [message.role for message in prompt(name).render(context)] == ["system", "user"]


@given(names, ranges, ranges)
def test_ranges_come_from_the_schema(name, one, other):
    def text(bounds):
        schema = ActionSchema("place", (), (Parameter("x", *bounds, "m"),))
        return text_of(prompt(name).render(replace(EMPTY, actions=(schema,))))

    assert f"x from {one[0]} to {one[1]} m." in text(one)
    assert (text(one) == text(other)) == ([*map(repr, one)] == [*map(repr, other)])


@pytest.mark.parametrize("name", SHIPPED)
def test_how_an_action_is_written_is_shown_in_the_form_that_is_asked_for(name):
    text = text_of(prompt(name).render(EMPTY))
    assert "- pick(['<box>'], {}): pick up the box from above.\n" in text
    assert "- place(['<box>'], {'x': <number>, 'theta': <number>, 'speed': <number>}): put the held box down. " in text
    assert "x from 0 to 1 m, theta from -3.14 to 3.14 rad, speed from 0.5 to 2." in text
    assert "- wait([], {}).\n" in text
    assert '"Full Plan": ["pick([\'<box>\'], {})", ' in text


@pytest.mark.parametrize("name", SHIPPED)
def test_a_world_without_objects_names_none(name):
    text = text_of(prompt(name).render(replace(EMPTY, objects=(), actions=Line.schemas[:1])))
    assert "Objects that" not in text
    assert "object's name" not in text


def test_strategies_ask_differently():
    texts = {text_of(prompt(name).render(FULL)) for name in SHIPPED}
    assert len(texts) == 3


def test_markup_in_what_a_domain_or_a_model_wrote_is_no_template():
    context = replace(EMPTY, task="{{ 1 + 1 }} {% if x %} <b> & 'quotes'")
    assert "{{ 1 + 1 }} {% if x %} <b> & 'quotes'" in text_of(prompt("backtrack").render(context))


# ---- a strategy of somebody else -----------------------------------------------------------------------------------


@pytest.fixture
def third_party(tmp_path, monkeypatch):
    """Makes the strategy of a package that holds this template."""
    package = tmp_path / "scratch_strategies"
    package.mkdir()
    (package / "__init__.py").write_text("", encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)

    def make(template, name="short.j2"):
        (package / name).write_text(template, encoding="utf-8")
        return Strategy("scratch_strategies", name)

    yield make
    sys.modules.pop("scratch_strategies", None)


def complaint(strategy, context=EMPTY):
    with pytest.raises(PluginError) as caught:
        Prompt(strategy).render(context)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_it_may_include_the_shipped_partials_and_its_own(third_party):
    third_party("Be quick.", "manner.j2")
    strategy = third_party(
        '{% call message("system") %}{% include "llm3_templates/partials/role.j2" %}\n'
        '{% include "scratch_strategies/manner.j2" %}{% endcall %}\n'
        '{% call message("user") %}{% include "llm3_templates/partials/task.j2" %}{% endcall %}\n'
        '{% call message("assistant") %}{% for a in actions %}{{ a | usage }};{% endfor %}{% endcall %}\n'
    )
    system, user, assistant = Prompt(strategy).render(EMPTY)
    shipped = prompt("scratch").render(EMPTY)
    assert system.role == "system"
    assert system.content.endswith("Be quick.")
    assert user.content in shipped[1].content
    assert assistant == Message(
        "assistant",
        "pick(['<box>'], {});place(['<box>'], {'x': <number>, 'theta': <number>, 'speed': <number>});wait([], {});",
    )


@pytest.mark.parametrize(
    ("property_", "written"),
    [
        (0.1 + 0.2, "0.30000000000000004"),
        (-0.5, "-0.5"),
        (3, "3"),
        ("open", "open"),
        ((0.39, -0.2, 0), "(0.39, -0.2, 0.0)"),
        ((1.5,), "(1.5)"),
    ],
)
def test_numbers_are_written_to_the_last_digit(third_party, property_, written):
    strategy = third_party('{% call message("user") %}{{ state[0].properties["p"] | value }}{% endcall %}')
    context = replace(EMPTY, state=(Entity("thing", {"p": property_}),))
    assert Prompt(strategy).render(context) == (Message("user", written),)


@pytest.mark.parametrize(
    ("template", "wrong"),
    [
        ('{% call message("user") %}{{ colour }}{% endcall %}', "cannot be rendered: 'colour' is undefined"),
        (
            '{% call message("user") %}{{ state[0].colour }}{% endcall %}',
            "cannot be rendered: 'llm3.types.dialogue.Entity object' has no attribute 'colour'",
        ),
        (
            '{% call message("user") %}{{ task + 1 }}{% endcall %}',
            'cannot be rendered: can only concatenate str (not "int") to str',
        ),
        (
            '{% call message("robot") %}Hello{% endcall %}',
            "cannot be rendered: unknown role 'robot'; roles are system, user, assistant",
        ),
        (
            '{% call message("user") %}{% include "elsewhere/partials/task.j2" %}{% endcall %}',
            "cannot be rendered: elsewhere/partials/task.j2",
        ),
        ("{# nothing #}", "writes no message: use {% call message(role) %}."),
        (
            'You plan.{% call message("user") %}Plan!{% endcall %}',
            "writes text outside of its messages: 'You plan.'.",
        ),
        (
            '{% call message("user") %}\n{{ task }\n{% endcall %}',
            "cannot be loaded: unexpected '}' (line 2)",
        ),
        ("\n\n{% paint %}", "cannot be loaded: Encountered unknown tag 'paint'. (line 3)"),
        ("{{ task | shout }}", "cannot be loaded: No filter named 'shout'. (line 1)"),
    ],
)
def test_what_is_wrong_with_a_template_is_told_in_one_line(third_party, template, wrong):
    assert complaint(third_party(template)) == f"prompt template 'scratch_strategies/short.j2' {wrong}"


def test_a_template_or_a_package_that_is_not_there_is_named(third_party):
    third_party("")
    assert complaint(Strategy("scratch_strategies", "long.j2")).startswith(
        "prompt template 'scratch_strategies/long.j2' cannot be loaded: "
    )
    assert complaint(Strategy("no_such_package", "long.j2")) == (
        "prompt template 'no_such_package/long.j2' cannot be loaded: No module named 'no_such_package'"
    )
