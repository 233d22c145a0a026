"""The settings: problems from a seed, which are solved without a model, and stand up to a second look."""

from __future__ import annotations

import pytest
from plane_world import DOMAIN

from llm3.jsonio import dumps
from llm3_tabletop2d.actions import LARGEST_CARRIED, skeleton

SETTINGS = DOMAIN.settings


@pytest.mark.parametrize("setting", SETTINGS)
def test_a_seed_gives_one_problem_and_another_seed_another_one(setting):
    problems = [dumps(DOMAIN.instance(setting, seed)) for seed in range(30)]
    assert len(set(problems)) == 30
    assert problems == [dumps(DOMAIN.instance(setting, seed)) for seed in range(30)]


@pytest.mark.parametrize("setting", SETTINGS)
def test_every_problem_is_one_that_makes_sense(setting):
    for seed in range(10):
        for radius in ("0", "0.04"):
            env = DOMAIN.make(DOMAIN.instance(setting, seed), {"robot_radius": radius})
            assert not env.goal(env.reset()).achieved


@pytest.mark.parametrize("setting", SETTINGS)
def test_the_stand_in_solves_it_and_the_plan_has_no_defect(solve, setting):
    result, _, report = solve(setting=setting, seed=0)
    assert result.solved
    assert report.defects == ()
    assert report.configurations > 200
    assert report.deepest_contact == 0.0
    assert report.clearances["transit"] > 0.0009


@pytest.mark.slow
@pytest.mark.parametrize("setting", SETTINGS)
def test_the_stand_in_solves_ten_seeds_of_ten(solve, setting):
    for seed in range(10):
        result, _, report = solve(setting=setting, seed=seed)
        assert result.solved, seed
        assert report.defects == (), seed


@pytest.mark.parametrize("setting", ["open", "push"])
def test_a_search_solves_it_and_the_plan_has_no_defect(solve, setting):
    result, _, report = solve(setting=setting, seed=1, solver="search")
    assert result.solved
    assert report.defects == ()


@pytest.mark.parametrize("radius", ["0", "0.02"])
def test_it_is_solved_by_a_smaller_robot_too(solve, radius):
    result, _, report = solve(setting="walls", seed=1, options={"robot_radius": radius})
    assert result.solved
    assert report.defects == ()


def test_the_same_seed_gives_the_same_plan(solve):
    assert solve(setting="clutter", seed=2)[1] == solve(setting="clutter", seed=2)[1]


def test_a_plan_has_times(solve):
    result, _, report = solve(setting="swap", seed=0, timing="toppra")
    assert report.defects == ()
    assert all(step.motion.duration > 0 for step in result.plan)


def test_what_each_setting_is_about():
    problems = {setting: DOMAIN.instance(setting, 0) for setting in SETTINGS}
    assert problems["open"].walls == ()
    assert [i.name for i in problems["clutter"].objects if not problems["clutter"].region_of(i.name)] == ["grey_box"]
    assert [i.name for i in problems["push"].objects if max(i.size) > LARGEST_CARRIED] == ["brown_box"]
    area = sum(i.size[0] * i.size[1] for i in problems["packing"].objects)
    (tray,) = problems["packing"].regions
    assert area > 0.4 * tray.size[0] * tray.size[1]


def test_the_skeletons():
    def steps(setting: str) -> list[str]:
        return [f"{s.name} {s.objects[0]}" for s in skeleton(DOMAIN.instance(setting, 0))]

    assert steps("walls") == ["pick red_disc", "place red_disc", "pick blue_box", "place blue_box"]
    assert steps("clutter") == ["pick grey_box", "place grey_box", "pick red_disc", "place red_disc"]
    assert steps("push") == ["pick red_disc", "place red_disc", "push brown_box"]
    assert steps("swap") == [
        "push red_disc",
        "pick blue_box",
        "place blue_box",
        "pick red_disc",
        "place red_disc",
    ]


def test_random_parameters_are_drawn_where_they_can_work(solve):
    regions = DOMAIN.regions(DOMAIN.instance("walls", 0))
    assert regions["place", ("red_disc",), "x"][0] > 0.83
    result, _, _ = solve(setting="walls", seed=0, llm="random", strategy="sample-params", max_llm_calls=2)
    assert result.stats.llm_calls == 2
    clutter = DOMAIN.regions(DOMAIN.instance("clutter", 0))
    assert clutter["push", ("grey_box",), "x"] == pytest.approx((0.04, 1.16))


def test_the_experiment_compares_what_needs_no_model():
    from llm3.experiments import experiment_of, parse_toml
    from llm3_tabletop2d.plugin import llm3_experiments

    text = llm3_experiments()["tabletop2d"]()
    experiment = experiment_of(parse_toml(text, "tabletop2d"), "tabletop2d")
    assert [problem.name for problem in experiment.problems] == list(SETTINGS)
    assert [method.name for method in experiment.methods] == ["offline", "search", "random"]
