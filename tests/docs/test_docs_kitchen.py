from __future__ import annotations

import ast
import dataclasses

import pytest
from docs_pages import ROOT, blocks, names, page, table

from llm3 import Registry
from llm3.experiments import experiment_of, parse_toml
from llm3.jsonio import loads
from llm3_kitchen import cramped, feasts, goods, instance, layout, lessons, meals, settings, slots, store, whereabouts
from llm3_kitchen.domain import Kitchen
from llm3_kitchen.instance import KINDS, ClutterSpec, FoodSpec, KitchenInstance, PlaceSpec

PAGE = page("kitchen")
FLAT = " ".join(PAGE.split())


def listed(numbers: tuple[float, ...]) -> str:
    return ", ".join(f"{number:g}" for number in numbers)


def told() -> set[str]:
    """All sentences in backticks in a list."""
    return {line.removeprefix("- `").removesuffix("`") for line in PAGE.splitlines() if line.startswith("- `")}


def test_the_settings_are_those_of_the_domain():
    problems = {name: Kitchen().instance(name, 0) for name in Kitchen.settings}
    rows = [(f"`{name}`", str(len(one.foods)), str(len(one.clutter))) for name, one in problems.items()]
    assert [tuple(row) for row in table(PAGE, "Settings", "setting").rows] == rows
    assert f"The default is `{Kitchen.default_setting}`" in PAGE


@pytest.mark.parametrize(
    ("heading", "column", "sizes"),
    [
        ("Settings", "thing", {**goods.FOODS, **goods.CLUTTER}),
        ("The larger kitchens", "more", {**goods.MORE_FOODS, **goods.MORE_CLUTTER}),
        ("The cramped kitchens", "tall food", goods.TALL_FOODS),
    ],
)
def test_the_sizes_are_those_of_the_settings(heading, column, sizes):
    rows = [(f"`{name}`", listed(size)) for name, size in sizes.items()]
    assert [tuple(row) for row in table(PAGE, heading, column).rows] == rows


@pytest.mark.parametrize(
    ("heading", "column", "places"),
    [("Settings", "place", meals.PLACES), ("The larger kitchens", "larger place", feasts.PLACES)],
)
def test_the_places_are_those_of_the_settings(heading, column, places):
    rows = [(f"`{p.name}`", f"`{p.kind}`", listed(p.center), listed(p.size)) for p in places]
    assert [tuple(row) for row in table(PAGE, heading, column).rows] == rows


@pytest.mark.parametrize(
    "text",
    [
        f"turned by up to {store.MOST_TURNED:g} rad either way",
        f"foods are {store.FINGER_ROOM * 1000:g} mm apart",
        "clutter stands {:g} to {:g} mm beside".format(*(1000 * gap for gap in store.SNUG)),
        f"stands in {('zero', 'one', 'two', 'three', 'four')[feasts.COLUMNS]} columns",
        "low: {} or `{}`".format(
            ", ".join(f"`{name}`" for name in [*cramped.LOW_FOODS][:-1]), [*cramped.LOW_FOODS][-1]
        ),
        "The sink, {:g} by {:g} m".format(*cramped.SINK.size),
        "the stove, {:g} by {:g} m".format(*cramped.STOVE.size),
        f"{1000 * cramped.GAP:g} mm apart",
        f"two rows, {slots.WORKTOP_PITCH[0]:g} m for each thing",
        f"a plate of {layout.PLATE_HEIGHT * 1000:g} mm",
        f"a rim {layout.RIM_HEIGHT * 1000:g} mm high and {instance.RIM_THICKNESS * 1000:g} mm thick",
        f"are {instance.MOST_THINGS} at most",
        f"with its whole footprint, within {whereabouts.TOLERANCE * 1000:g} mm",
        f"after {('zero', 'one', 'two', 'three', 'four')[lessons.PATIENCE]} failures behind the same beginning",
        ", ".join(f"`{kind}`" for kind in KINDS[:-1]) + f" or `{KINDS[-1]}`",
    ],
)
def test_the_page_has_the_figures_of_the_code(text):
    assert text in FLAT


@pytest.mark.pybullet
def test_the_figures_of_the_second_look():
    from llm3_kitchen import verification

    assert f"or on a stove then, within {verification.OUT_OF_PLACE * 1000:g} mm" in FLAT
    assert f"has to be within {verification.OUT_OF_PLACE * 1000:g} mm of the place" in FLAT


def test_the_example_of_an_instance_file_loads():
    (example,) = blocks(PAGE, "json")
    loaded = loads(example.text, KitchenInstance, "docs/kitchen.md")
    assert [food.name for food in loaded.foods] == ["corn", "bread"]


@pytest.mark.parametrize(
    ("column", "structure"),
    [("field", KitchenInstance), ("field of a place", PlaceSpec), ("field of a food", FoodSpec)],
)
def test_every_field_of_an_instance_file_is_documented(column, structure):
    shown = table(PAGE, "Instance files", column)
    assert shown.names == tuple(field.name for field in dataclasses.fields(structure))


def test_clutter_has_the_first_fields_of_food():
    assert "Clutter has the first four of these" in PAGE
    fields = [field.name for field in dataclasses.fields(FoodSpec)]
    assert [field.name for field in dataclasses.fields(ClutterSpec)] == fields[:4]


def test_the_sentences_are_those_that_the_domain_is_tested_for():
    """Those of preconditions and of the goal, each of which a test asserts whole."""
    tree = ast.parse((ROOT / "tests/kitchen/test_kitchen_env.py").read_text(encoding="utf-8"))
    tested = {node.value for node in ast.walk(tree) if isinstance(node, ast.Constant) and isinstance(node.value, str)}
    assert told() <= tested


def test_the_figures_of_others_are_those_of_the_experiment():
    experiment = experiment_of(parse_toml(Registry.discover().experiment("kitchen"), "kitchen"), "kitchen")
    (published,) = experiment.published
    row = next(row for row in table(PAGE, "What solves it").rows if row[0] == published.label)
    solved = [f"{published.of('LLM3', name)['success'] / 10:g}/10" for name in settings.MEALS]
    assert list(row[1::2]) == solved
    search = next(method for method in experiment.methods if method.name == "search")
    assert f"it was given {search.settings['max_motion_calls']} of them" in FLAT
    assert len(experiment.seeds) == 10


def test_the_actions_are_those_of_the_domain():
    from llm3_kitchen.actions import HEAT, PICK, PLACE, WASH

    assert [names(row[0])[0].partition("(")[0] for row in table(PAGE, "Actions").rows] == [
        schema.name for schema in (PICK, PLACE, WASH, HEAT)
    ]
    assert f"x and y {PLACE.parameters[0].low:g} to {PLACE.parameters[0].high:g} m" in PAGE
