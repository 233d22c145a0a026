"""Problems that are made from solutions: what each family promises, and that the solution is one."""

from __future__ import annotations

from dataclasses import replace
from math import hypot, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from packing_world import BASKET, after, box, pick, place, problem, refused

from llm3.assembly import RunConfig, open_problem
from llm3.errors import UsageError
from llm3.interfaces import PlannerSettings
from llm3.jsonio import dumps, loads, pretty
from llm3.registry import Registry
from llm3.solve import context_of
from llm3.types import Action, Failure, FailureKind, State
from llm3.witness import witness
from llm3_boxpack.domain import BoxPack
from llm3_boxpack.families import FAMILIES, drafted
from llm3_boxpack.families.hand import Hand
from llm3_boxpack.instance import BoxpackInstance, BoxSpec
from llm3_boxpack.paper_settings import SETTINGS as OF_THE_PAPER
from llm3_bullet.robots import panda
from llm3_bullet.tabletop.rectangles import Rectangle

MADE = BoxPack.settings[9:]
SMALLEST = ("dense-6", "far-4", "clutter-4", "lanes-4")
made = st.sampled_from(MADE)
seeds = st.integers(0, 10**9)
some = settings(max_examples=5, deadline=None)


def solution(setting: str, seed: int) -> tuple[Action, ...]:
    found = BoxPack().witness(setting, seed)
    assert found
    return found


def places(actions: tuple[Action, ...]) -> dict[str, Action]:
    return {action.objects[0]: action for action in actions if action.name == "place"}


def covered(spec: BoxSpec, action: Action) -> Rectangle:
    x, y, theta = (action.params[name] for name in ("x", "y", "theta"))
    return Rectangle((x, y), spec.size[:2], (np.cos(theta), np.sin(theta)))


def test_the_families_and_their_sizes():
    assert (
        *("dense-6", "dense-8", "dense-10", "dense-12"),
        *("far-4", "far-8"),
        *("clutter-4", "clutter-8"),
        *("lanes-4", "lanes-8"),
    ) == MADE


@pytest.mark.parametrize(
    ("family", "count", "sentence"),
    [
        ("stairs", 6, "unknown family 'stairs'. Known: clutter, dense, far, lanes."),
        ("dense", 3, "a family has from 4 to 12 boxes, not 3."),
        ("dense", 13, "a family has from 4 to 12 boxes, not 13."),
    ],
)
def test_a_family_or_a_size_that_is_not_there_is_refused(family, count, sentence):
    with pytest.raises(UsageError) as caught:
        drafted(family, count, 0)
    assert str(caught.value) == sentence


@settings(max_examples=10, deadline=None)
@given(st.sampled_from(sorted(FAMILIES)), st.integers(4, 12), seeds)
def test_any_size_between_can_be_had(family, count, seed):
    instance = drafted(family, count, seed).instance
    assert len(instance.boxes) == count
    assert len(instance.clutter) == (count if family == "clutter" else 0)


# ---- what holds for all of them --------------------------------------------------------------------------------------


@some
@given(made, seeds)
def test_a_seed_gives_one_instance_with_one_solution_and_another_seed_another(setting, seed):
    domain = BoxPack()
    instance = domain.instance(setting, seed)
    assert domain.instance(setting, seed) == instance
    assert solution(setting, seed) == solution(setting, seed)
    assert domain.instance(setting, seed + 1) != instance
    assert loads(pretty(instance), BoxpackInstance, "the instance") == instance


@some
@given(made, seeds)
def test_there_are_as_many_boxes_as_the_setting_says_and_none_is_square(setting, seed):
    instance = BoxPack().instance(setting, seed)
    family, _, count = setting.partition("-")
    assert len(instance.boxes) == int(count)
    assert len(instance.clutter) == (int(count) if family == "clutter" else 0)
    assert instance.basket.walls == 0.05
    assert all(abs(thing.size[0] - thing.size[1]) > 0.0039 for thing in instance.things)
    assert all(min(thing.size[:2]) <= 0.072 for thing in instance.things)


@some
@given(made, seeds)
def test_all_lengths_are_whole_millimetres(setting, seed):
    instance = BoxPack().instance(setting, seed)
    numbers = [*instance.basket.center, *instance.basket.size]
    numbers += [number for thing in instance.things for number in (*thing.size, *thing.position)]
    numbers += [action.params[name] for action in places(solution(setting, seed)).values() for name in "xy"]
    assert all(number == round(number, 3) for number in numbers)


@some
@given(made, seeds)
def test_the_solution_packs_every_box_apart_from_the_others_and_from_the_walls(setting, seed):
    instance, goals = BoxPack().instance(setting, seed), places(solution(setting, seed))
    footprints = [covered(spec, goals[spec.name]) for spec in instance.boxes]
    grown = [replace(area, size=(area.size[0] + 0.0025, area.size[1] + 0.0025)) for area in footprints]
    for index, area in enumerate(grown):
        assert instance.basket.area.overhang(area) < 1e-4
        assert not any(area.overlaps(other) for other in grown[:index])


@some
@given(made, seeds)
def test_the_solution_is_no_part_of_the_instance(setting, seed):
    instance, goals = BoxPack().instance(setting, seed), places(solution(setting, seed))
    names = [spec.name for spec in instance.boxes]
    assert names == sorted(names)  # and not in the order of packing
    starts = {spec.position for spec in instance.things}
    assert not starts & {(goals[name].params["x"], goals[name].params["y"]) for name in names}
    fields = loads(dumps(instance), dict, "the instance")
    assert set(fields) == {"basket", "boxes", "clutter"}


@some
@given(made, seeds)
def test_everything_is_picked_once_and_put_down_at_once(setting, seed):
    actions = solution(setting, seed)
    picked = [action.objects[0] for action in actions[::2]]
    assert [(action.name, action.objects[0]) for action in actions[1::2]] == [("place", name) for name in picked]
    assert sorted(picked) == sorted(thing.name for thing in BoxPack().instance(setting, seed).things)
    pieces = BoxPack().pieces(BoxPack().instance(setting, seed))
    assert sorted(piece[0].objects[0] for piece in pieces) == sorted(picked)


@pytest.mark.parametrize("setting", MADE)
def test_no_sequence_is_given_as_the_order_has_to_be_found(setting):
    assert BoxPack().skeleton(BoxPack().instance(setting, 0)) is None


def test_no_solution_is_known_of_the_papers_settings():
    assert all(BoxPack().witness(setting, 0) is None for setting in OF_THE_PAPER)


# ---- what each of them promises --------------------------------------------------------------------------------------


@some
@given(st.sampled_from([setting for setting in MADE if setting.startswith(("dense", "clutter"))]), seeds)
def test_the_boxes_of_dense_trays_cover_55_to_80_percent(setting, seed):
    instance = BoxPack().instance(setting, seed)
    share = sum(spec.footprint.area for spec in instance.boxes) / instance.basket.area.area
    assert 0.55 <= share <= 0.80


@some
@given(st.sampled_from(["far-4", "far-8"]), seeds)
def test_a_part_of_a_far_tray_is_out_of_reach_and_the_solution_keeps_away_from_it(setting, seed):
    instance = BoxPack().instance(setting, seed)
    far_end = instance.basket.center[0] + instance.basket.size[0] / 2
    assert far_end > 0.92  # from above, the arm reaches to 0.80 m
    for action in places(solution(setting, seed)).values():
        assert hypot(action.params["x"], action.params["y"]) <= 0.77
    near_part = (0.77 - (instance.basket.center[0] - instance.basket.size[0] / 2)) * instance.basket.size[1]
    assert sum(spec.footprint.area for spec in instance.boxes) >= 0.55 * near_part


@some
@given(st.sampled_from(["clutter-4", "clutter-8"]), seeds)
def test_half_of_the_clutter_starts_in_the_tray_and_all_of_it_goes_aside_first(setting, seed):
    instance, actions = BoxPack().instance(setting, seed), solution(setting, seed)
    tray = instance.basket.area
    inside = [thing for thing in instance.clutter if tray.overlaps(thing.footprint)]
    assert 2 * len(inside) == len(instance.clutter)
    moved = [action.objects[0] for action in actions[::2]]
    assert set(moved[: len(instance.clutter)]) == {thing.name for thing in instance.clutter}
    assert not any(tray.overlaps(covered(thing, places(actions)[thing.name])) for thing in instance.clutter)


# ---- in the robot's world --------------------------------------------------------------------------------------------


def certified(setting: str, seed: int) -> int:
    """How many actions a sound plan has."""
    registry, usual = Registry.discover(), RunConfig("boxpack")
    domain = registry.domain("boxpack")
    planner = registry.planner(usual.planner, PlannerSettings(usual.planner_iterations, usual.planner_seconds))
    with open_problem(domain, domain.instance(setting, seed), {}) as opened:
        return len(witness(opened, setting, seed, planner).actions)


@pytest.mark.parametrize("setting", SMALLEST)
def test_the_solution_is_a_sound_plan(setting):
    assert certified(setting, 0) == len(solution(setting, 0))


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 1000])
@pytest.mark.parametrize("setting", MADE)
def test_the_solutions_are_sound_plans(setting, seed):
    assert certified(setting, seed) == len(solution(setting, seed))


def only_the_hand(failure: Failure) -> bool:
    """Whether an action is impossible for the gripper, and not for the box alone."""
    parts = {contact.part for contact in failure.contacts}
    return failure.kind is FailureKind.GOAL_IN_COLLISION and parts == {"gripper"}


def with_all_else_packed(instance: BoxpackInstance, state: State, actions: tuple[Action, ...]) -> State:
    """The state with all that is not held where the solution puts it."""
    start = {thing.name: thing for thing in instance.things}
    poses = dict(state.poses)
    for name, action in places(actions).items():
        if name in poses:
            floor = instance.basket.floor.height if name in {spec.name for spec in instance.boxes} else 0.0
            there = replace(start[name], position=(action.params["x"], action.params["y"]), yaw=action.params["theta"])
            poses[name] = there.standing(floor).pose
    return replace(state, poses=poses)


@pytest.mark.parametrize("setting", ["clutter-4", "lanes-4", "lanes-8"])
def test_some_boxes_cannot_be_taken_at_first_because_of_the_hand_alone(make, setting):
    for seed in range(3):
        env = make(BoxPack().instance(setting, seed), None)
        answers = [env.prepare(env.reset(), pick(name), np.random.default_rng(0)) for name in env.objects]
        blocked = [answer for answer in answers if isinstance(answer, Failure)]
        assert len(blocked) >= 2
        assert all(map(only_the_hand, blocked)), seed


@pytest.mark.parametrize("setting", ["dense-6", "dense-8", "far-4"])
def test_some_boxes_fit_where_they_belong_and_the_hand_does_not_once_all_others_are_there(make, setting):
    for seed in range(2):
        instance, actions = BoxPack().instance(setting, seed), solution(setting, seed)
        env = make(instance, None)
        late = []
        for spec in instance.boxes:
            held = after(env, env.reset(), pick(spec.name))
            answer = env.prepare(
                with_all_else_packed(instance, held, actions), places(actions)[spec.name], np.random.default_rng(0)
            )
            late += [answer] if isinstance(answer, Failure) else []
        assert late
        assert all(map(only_the_hand, late)), seed


def refusals(make, setting: str, seed: int) -> tuple[list[object], list[object]]:
    """What the robot's world answers where the hand is said to have no room.

    First for picks at the start, then for the solution's places when all else is there.
    """
    family, _, count = setting.partition("-")
    draft, hand = drafted(family, int(count), seed), Hand.of(panda().gripper)
    env = make(draft.instance, None)
    picks = [env.prepare(env.reset(), pick(name), np.random.default_rng(0)) for name in draft.blocked_picks(hand)]
    where, put_down = places(draft.solution), []
    for name in draft.blocked_places(hand):
        (spec,) = [spec for spec in draft.instance.boxes if spec.name == name]
        alone = make(replace(draft.instance, boxes=(spec,), clutter=()), None)
        held = after(alone, alone.reset(), pick(name))
        others = {other: pose for other, pose in env.reset().poses.items() if other != name}
        full = with_all_else_packed(draft.instance, replace(held, poses=others), draft.solution)
        put_down.append(env.prepare(full, where[name], np.random.default_rng(0)))
    return picks, put_down


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0, 1, 1000, 1001])
@pytest.mark.parametrize("setting", MADE)
def test_what_is_impossible_for_the_hand_and_not_for_the_box_is_refused_by_the_robots_world(make, setting, seed):
    picks, put_down = refusals(make, setting, seed)
    assert picks or put_down
    assert all(isinstance(answer, Failure) and only_the_hand(answer) for answer in (*picks, *put_down))
    family, _, count = setting.partition("-")
    if family == "lanes":
        assert len(picks) >= int(count) / 2
    if family == "clutter":
        assert picks


@pytest.mark.parametrize("setting", MADE)
def test_the_state_of_a_prompt_is_short_and_tells_all_numbers(make, setting):
    instance = BoxPack().instance(setting, 0)
    env = make(instance, None)
    context = context_of(env, env.reset())
    text = "\n".join(str(entity) for entity in context.state)
    assert len(text) / 4 < 3000
    told = {entity.name: entity.properties for entity in context.state}
    for thing in instance.things:
        assert told[thing.name]["position"][:2] == thing.position
        assert told[thing.name]["size"] == thing.size
        assert {"fingertips", "palm", "theta"} <= set(told[thing.name])
    assert told["basket"]["wall height"] == 0.05


# ---- things that are not to be packed --------------------------------------------------------------------------------


def test_a_thing_in_the_way_may_end_anywhere_and_can_be_moved(make):
    instance = replace(
        problem(box("red_box", 0.39, 0.3)),
        clutter=(replace(BoxPack().instance("clutter-4", 0).clutter[0], position=(0.65, 0.0)),),
    )
    (thing,) = instance.clutter
    env = make(instance, None)
    start = env.reset()
    assert start.poses[thing.name].position[2] == pytest.approx(0.01 + thing.size[2] / 2)
    assert env.goal(start).unmet == ("red_box is not in the basket",)
    aside = after(env, start, pick(thing.name), place(thing.name, 0.5, -0.4))
    end = after(env, aside, pick("red_box"), place("red_box", 0.65, 0.0))
    assert env.goal(end).achieved
    blocked = after(env, start, pick("red_box"))
    assert refused(env, blocked, place("red_box", *BASKET.center)).objects == (thing.name,)


def test_a_wall_is_in_the_way_of_a_box_that_is_put_down_on_it(make):
    instance = problem(box("red_box", 0.39, 0.3), basket=replace(BASKET, walls=0.05))
    env = make(instance, None)
    held = after(env, env.reset(), pick("red_box"))
    assert "basket_wall_left" in refused(env, held, place("red_box", 0.65, 0.105, pi / 2)).objects
