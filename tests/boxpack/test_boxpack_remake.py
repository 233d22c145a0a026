"""A world that was made out of another one is as good as new, however many problems it has seen."""

from __future__ import annotations

import random
from contextlib import ExitStack, closing
from dataclasses import replace

import numpy as np
import pytest
from test_boxpack_memory import ALLOWED, growth

from llm3.assembly import RunConfig, assemble, prepare
from llm3.errors import InputError
from llm3.jsonio import dumps
from llm3.records.plan import plan_file
from llm3.registry import Registry
from llm3_boxpack.instance import BoxSpec
from llm3_boxpack.paper_settings import SETTINGS
from llm3_bullet.workcell import MOST_BODIES

PANDA = {"robot": "panda", "walls": "0"}


def outcome(run):
    """All that a run leaves, but for the time that it took."""
    result = run.solve()
    untimed = replace(result, stats=replace(result.stats, seconds={}))
    return dumps(untimed), dumps(plan_file(run.problem, result.start, result.plan))


def one_after_the_other(configs):
    """What each run leaves in a world that is made out of the one before, and whether that was the same robot's."""
    registry, spare, cell = Registry.discover(), None, None
    for config in configs:
        run = prepare(registry, config).open(spare=spare)
        left = outcome(run)
        spare = run.release()
        yield left, spare.tabletop.workcell is cell
        cell = spare.tabletop.workcell
    spare.close()


def new(config):
    with assemble(Registry.discover(), config) as run:
        return outcome(run)


def config(setting, seed=0, robot="panda", walls="0", **others):
    return RunConfig("boxpack", setting, seed, options={"robot": robot, "walls": walls}, **others)


def test_a_run_in_a_remade_world_leaves_the_same_bytes_as_one_in_a_new_world():
    series = (
        config("hard-small", 1),
        config("easy-large", 7, walls="0.1"),
        config("medium-small", 4, solver="search", max_motion_calls=40),
        config("hard-small", 2, robot="iiwa"),
    )
    remade, took_over = zip(*one_after_the_other(series), strict=True)
    assert took_over == (False, True, True, False)
    assert list(remade) == [new(config) for config in series]


@pytest.mark.slow
def test_a_long_series_of_them_does_so_too():
    draw = random.Random(0)
    series = [
        config(
            draw.choice(SETTINGS),
            draw.randrange(1000),
            draw.choice(("panda", "panda", "panda", "iiwa")),
            draw.choice(("0", "0.03", "0.08", "0.2")),
            **draw.choice(({}, {"solver": "search", "max_motion_calls": 60})),
        )
        for _ in range(40)
    ]
    remade, took_over = zip(*one_after_the_other(series), strict=True)
    assert any(took_over)
    assert list(remade) == [new(config) for config in series]


def test_a_problem_that_is_refused_leaves_the_world_to_its_owner(domain):
    instance = domain.instance("easy-small", 0)
    with closing(domain.make(instance, PANDA)) as env:
        under_the_arm = replace(instance, boxes=(BoxSpec("red_box", (0.2, 0.2, 0.5), (0.3, 0.0)),))
        with pytest.raises(InputError):
            domain.remake(env, under_the_arm, PANDA)
        assert domain.remake(env, instance, PANDA).reset() == env.reset()


def test_what_cannot_be_taken_over_is_refused(domain):
    instance = domain.instance("easy-small", 0)
    env = domain.make(instance, PANDA)
    assert domain.remake(env, instance, {**PANDA, "robot": "iiwa"}) is None
    env.close()
    assert domain.remake(env, instance, PANDA) is None


@pytest.mark.slow
def test_hundreds_of_remade_worlds_leave_memory_as_it_was(domain):
    with ExitStack() as stack:
        assert growth(_remaking(domain, stack, lambda _: "0.05"), 200, 1000) < ALLOWED


@pytest.mark.slow
def test_worlds_that_are_full_of_boxes_of_other_sizes_are_given_up(domain):
    heights = np.random.default_rng(0).uniform(0, 0.2, 2000).round(4).tolist()
    bodies = []
    with ExitStack() as stack:
        work = _remaking(domain, stack, lambda number: str(heights[number]), bodies.append)
        assert growth(work, 600, 600) < ALLOWED
    assert MOST_BODIES / 2 < max(bodies) < MOST_BODIES + 100


def _remaking(domain, stack, walls, tell=lambda _: None):
    """Make one world out of another, look around in it, and go on; the stack closes the last one."""
    env = None
    stack.callback(lambda: env.close())
    number = 0
    while True:
        instance, options = domain.instance(SETTINGS[number % len(SETTINGS)], number), {**PANDA, "walls": walls(number)}
        old, env = env, env and domain.remake(env, instance, options)
        if env is None:
            if old:
                old.close()
            env = domain.make(instance, options)
        checker = env.tabletop.workcell.checker
        checker.view(env.scene(env.reset())).valid(env.tabletop.workcell.model.home[None])
        tell(checker.thick_world.boxes.made)
        number += 1
        yield
