from __future__ import annotations

import dataclasses

import pytest
from docs_pages import blocks, names, page, table

from llm3 import Registry
from llm3.experiments import experiment_of, parse_toml
from llm3.jsonio import loads
from llm3.types import Failure, FailureKind, Held, Pose, State
from llm3_blocks import cubes, rebuild
from llm3_blocks.colors import COLORS
from llm3_blocks.domain import Blocks
from llm3_blocks.goal import goal_status
from llm3_blocks.instance import CLOSE, MOST_BLOCKS, BlocksInstance, BlockSpec, On, TowerSpec
from llm3_blocks.settings import LARGE, SMALL
from llm3_bullet.tabletop import manipulation, resting

PAGE = page("blocks")
FLAT = " ".join(PAGE.split())
TWO = BlocksInstance(
    (BlockSpec("red_block", (0.05, 0.05, 0.05)), BlockSpec("blue_block", (0.05, 0.05, 0.05))),
    (TowerSpec(("red_block", "blue_block"), (0.45, 0.1)),),
    (On("red_block", "blue_block"),),
)


def told() -> list[str]:
    """All sentences in backticks in a list."""
    return [line.removeprefix("- `").removesuffix("`") for line in PAGE.splitlines() if line.startswith("- `")]


def test_the_settings_are_those_of_the_domain():
    shown = table(PAGE, "Settings")
    assert shown.names == Blocks.settings
    told = tuple(name for row in shown.rows for name in names(row[1]))
    assert told == tuple(f"{color}_block" for color in COLORS)
    assert f"The default is `{Blocks.default_setting}`" in PAGE


@pytest.mark.parametrize(
    "text",
    [
        f"sides of {cubes.SIDE:g} m",
        f"with {cubes.SCATTERED:.0%} of the seeds".replace("%", " %"),
        f"towers of up to {cubes.TALLEST} blocks",
        "x from {} to {} and y from {} to {}".format(*cubes.START_X, *cubes.START_Y),
        f"turned by up to {cubes.MOST_YAW:g} rad",
        f"the middles {cubes.APART:g} m apart",
        f"{cubes.MOST_TOWERS} towers at the start at most, and always two towers in the goal, of up to {cubes.HIGHEST}",
        f"the blocks are {rebuild.LENGTH:g} m long",
        "{:g} to {:g} m wide".format(*rebuild.WIDTHS[::2]),
        "{:g} to {:g} m high".format(*rebuild.HEIGHTS[::2]),
        f"towers are less than {CLOSE:g} m apart",
        f"1 to {MOST_BLOCKS} of them",
        f"let go {manipulation.DROP * 1000:g} mm above",
        f"rests on it, within {resting.TOUCH * 1000:g} mm",
    ],
)
def test_the_page_has_the_figures_of_the_code(text):
    assert text in FLAT


def test_the_towers_of_a_rebuild_are_those_of_the_code():
    def told(counts: tuple[int, ...]) -> str:
        return ", ".join(map(str, counts))

    free = 2 * len(rebuild.CELLS)
    assert list(table(PAGE, "Towers in step").rows) == [
        (f"`rebuild-{n}`", told(start), told(rebuild.GOAL[n]), f"{len(start)}", f"{free - n}")
        for n, start in rebuild.START.items()
    ]


def test_the_lengths_of_the_known_solutions():
    known = [len(Blocks().witness(setting, 0)) for setting in LARGE if setting.startswith("rebuild")]
    assert "The motions of the known solutions are {}, {} and {}.".format(*known) in FLAT


@pytest.mark.pybullet
def test_the_figures_of_the_second_look():
    from llm3_blocks import verification
    from llm3_bullet.verification import deeds

    assert f"over the middle of the other one, within {deeds.OFF_PLACE * 1000:g} mm" in FLAT
    assert f"within {verification.APART * 1000:g} mm of what it belongs on" in FLAT
    assert f"no more than {verification.BESIDE * 1000:g} mm beside it" in FLAT


def test_the_example_of_an_instance_file_loads():
    (example,) = blocks(PAGE, "json")
    loaded = loads(example.text, BlocksInstance, "docs/blocks.md")
    assert [block.name for block in loaded.blocks] == ["red_block", "blue_block", "tan_slab"]


@pytest.mark.parametrize(
    ("column", "structure"),
    [
        ("field", BlocksInstance),
        ("field of a block", BlockSpec),
        ("field of a tower", TowerSpec),
        ("field of a part of the goal", On),
    ],
)
def test_every_field_of_an_instance_file_is_documented(column, structure):
    shown = table(PAGE, "Instance files", column)
    assert shown.names == tuple(field.name for field in dataclasses.fields(structure))


def test_what_is_missing_of_the_goal_reads_as_documented():
    on_table, in_hand = Pose((0.5, 0.0, 0.025)), Held("red_block", Pose((0.0, 0.0, 0.0)))
    to_table = dataclasses.replace(TWO, goal=(On("red_block", "table"),))
    other = dataclasses.replace(TWO, goal=(On("blue_block", "table"),))
    for problem, state in (
        (TWO, State({"red_block": on_table, "blue_block": Pose((0.3, 0.0, 0.025))})),
        (to_table, State({"red_block": Pose((0.5, 0.0, 0.075)), "blue_block": on_table})),
        (TWO, State({"blue_block": on_table}, held=in_hand)),
        (other, State({"blue_block": on_table}, held=in_hand)),
    ):
        (sentence,) = goal_status(problem, state).unmet
        assert sentence in told()


def test_the_preconditions_of_a_hand_read_as_documented():
    gripper = Registry  # any: what is in the hand is asked before what takes it
    hands = manipulation.Manipulation(TWO.sizes, (), gripper)  # type: ignore[arg-type]
    pose = Pose((0.4, 0.0, 0.025))
    holding = State({"red_block": pose}, held=Held("blue_block", Pose((0.0, 0.0, 0.0))))
    for failure in (
        hands.in_hand(State({"red_block": pose}), "red_block", "stack"),
        hands.in_hand(holding, "red_block", "stack"),
    ):
        assert isinstance(failure, Failure)
        assert failure.kind is FailureKind.PRECONDITION
        assert failure.detail in told()


def test_the_figures_of_others_are_those_of_the_experiment():
    experiment = experiment_of(parse_toml(Registry.discover().experiment("blocks"), "blocks"), "blocks")
    (published,) = experiment.published
    row = next(row for row in table(PAGE, "What solves it").rows if row[0] == "a re-run with gpt-4o")
    figures = [published.of("LLM3", setting) for setting in SMALL]
    shown = [text for f in figures for text in (f"{f['success'] / 10:g}/10", f"{f['llm_calls']:g}")]
    assert list(row[1:]) == shown
    search = next(method for method in experiment.methods if method.name == "search")
    assert f"it was given {search.settings['max_motion_calls']} of them" in FLAT
    assert len(experiment.seeds) == 10
