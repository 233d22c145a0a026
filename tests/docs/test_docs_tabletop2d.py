from __future__ import annotations

import dataclasses

import pytest
from docs_pages import ROOT, blocks, names, page, table, tables

from llm3.jsonio import loads
from llm3.types import Contact, Failure, FailureKind
from llm3_tabletop2d import actions, instance, manipulation, reach, settings, ways
from llm3_tabletop2d.domain import MAX_RADIUS, Tabletop2D
from llm3_tabletop2d.instance import GoalSpec, ObjectSpec, RectangleSpec, TabletopInstance
from llm3_words.sentences import sentence_of

PAGE = page("tabletop2d")
FLAT = " ".join(PAGE.split())


def test_the_settings_and_the_options_are_those_of_the_domain():
    assert table(PAGE, "Settings").names == Tabletop2D.settings
    assert f"`{Tabletop2D.default_setting}` is the default" in PAGE
    shown = [(name.strip("`"), default.strip("`")) for name, default, _ in table(PAGE, "Options").rows]
    assert shown == [(option.name, option.default) for option in Tabletop2D.options]
    assert f"0 (a point) to {MAX_RADIUS:g} m" in FLAT


def test_the_actions_are_those_of_the_domain():
    shown = {row[0].strip("`").partition("(")[0]: names(row[0])[0] for row in table(PAGE, "Actions").rows}
    for schema in actions.schemas(settings.ROOM):
        parameters = ", ".join(parameter.name for parameter in schema.parameters)
        assert shown.pop(schema.name) == f"{schema.name}([{schema.objects[0]}], {{{parameters}}})"
    assert not shown


@pytest.mark.parametrize(
    ("column", "structure"),
    [
        ("field", TabletopInstance),
        ("field of an object", ObjectSpec),
        ("field of a region or a wall", RectangleSpec),
        ("field of a goal", GoalSpec),
    ],
)
def test_every_field_of_an_instance_file_is_documented(column, structure):
    shown = {row[0].strip("`") for row in table(PAGE, "Instance files", column).rows}
    assert shown == {field.name for field in dataclasses.fields(structure)}


def test_the_example_of_an_instance_file_loads():
    (example,) = blocks(PAGE, "json")
    loaded = loads(example.text, TabletopInstance, "docs/tabletop2d.md")
    assert [item.name for item in loaded.objects] == ["red_disc", "blue_box"]
    Tabletop2D().make(loaded, {"robot_radius": "0.03"}).close()


@pytest.mark.parametrize(
    "text",
    [
        f"a room of {settings.ROOM[0]:g} by {settings.ROOM[1]:g} m",
        f"a side of more than {actions.LARGEST_CARRIED:g} m",
        f"keeps {ways.CLEARANCE * 1000:g} mm away from everything",
        f"sampled every {ways.RESOLUTION * 1000:g} mm",
        f"which keep {ways.MARGIN * 1000:g} mm",
        f"{manipulation.STANDOFF * 1000:g} mm away (`STANDOFF`) to {manipulation.TOUCH * 1000:g} mm (`TOUCH`)",
        f"up to {actions.MAX_VELOCITY:g} m/s and {actions.MAX_ACCELERATION:g} m/s²",
        f"The tolerance is {instance.TOLERANCE * 1000:g} mm",
        f"are {reach.CELL * 100:g} cm wide (`CELL`)",
    ],
)
def test_the_page_has_the_figures_of_the_code(text):
    assert text in FLAT


def test_failures_read_as_documented():
    cut_off = Failure(
        FailureKind.UNREACHABLE,
        "It is cut off: no gap on the way there is wide enough for the robot and red_disc. grey_box is in the way.",
        ("grey_box",),
    )
    outside = "The robot would have to stand outside of the room, at (0.500, -0.032)."
    shown = [(kind.strip("`"), sentence.strip("`")) for kind, sentence in table(PAGE, "Failures").rows]
    assert shown == [
        (failure.kind.value, sentence_of(failure))
        for failure in (
            Failure(FailureKind.GOAL_IN_COLLISION, contacts=(Contact("held red_disc", "blue_box"),)),
            Failure(FailureKind.UNREACHABLE, outside),
            cut_off,
        )
    ]


def test_what_is_told_is_what_the_tests_of_the_world_expect():
    world = " ".join((ROOT / "tests/tabletop2d/test_tabletop2d_env.py").read_text(encoding="utf-8").split())
    world = world.replace('" "', "")  # texts that are broken over two lines
    told = [line.removeprefix("- `").removesuffix("`") for line in PAGE.splitlines() if line.startswith("- `")]
    assert len(told) == 8
    for sentence in told:
        assert sentence in world


def test_the_table_of_what_is_solved_has_every_setting():
    (solved,) = [t for t in tables(PAGE) if t.heading == "What solves it"]
    assert tuple(row[0].strip("`") for row in solved.rows) == Tabletop2D.settings
