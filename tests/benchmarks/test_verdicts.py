"""What a collision verdict costs, against the collision function of the published LLM3, and whether the two agree.

    OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 python -m pytest tests/benchmarks/test_verdicts.py -s

Both answer for the same collision-free configurations of one box-packing scene. For the ratios, a table in Markdown,
they take turns, some calls each, and it is the time of the processor that counts. Only agreement is asserted: times
belong to a machine, and to how busy it is.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from time import process_time

import numpy as np
import pytest
from published_checker import PublishedChecker, published_checker

from llm3.types import Pose
from llm3_boxpack.env import BoxpackEnv
from llm3_boxpack.paper_settings import generate
from llm3_bullet.clients import connect
from llm3_bullet.collision import CollisionChecker, SceneChecker
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.robots import panda
from llm3_bullet.scene import HeldBox, Scene
from llm3_bullet.workcell import Workcell

SIZES = (1, 8, 32, 128, 512)
ROUNDS = 200
TURNS, CALLS = 20, 15
"""How often each takes its turn, and the calls of a turn; the first few are not timed."""
COUNT = 10_000
"""Configurations that must get the same verdict."""
SHALLOW = 0.001
"""Metres of penetration up to which verdicts may differ: PyBullet's margin around a hull."""
HANDS = ("free arm", "held box")


@dataclass(frozen=True)
class Setup:
    """One scene, both checkers in it, and configurations of which both say that they are free."""

    view: SceneChecker
    published: PublishedChecker
    free: np.ndarray

    def batch(self, rng: np.random.Generator, size: int) -> np.ndarray:
        """Free configurations (size, dof), drawn without replacement."""
        return self.free[rng.choice(len(self.free), size, replace=False)]

    def padded(self, q: np.ndarray) -> list[float]:
        """A configuration as pybullet-planning wants it."""
        return [*q, *self.published.fingers]


@pytest.fixture(scope="module", params=HANDS)
def setup(request) -> Iterator[Setup]:
    cell = Workcell(panda())
    env = BoxpackEnv(generate("hard-medium", 0), cell)
    scene = env.scene(env.reset())
    env.close()
    if request.param == "held box":
        scene = _with_held(scene, "red_box")
    model = RobotModel(panda())
    with connect() as client, connect() as step_client, published_checker(panda(), scene) as published:
        checker = CollisionChecker(client, model, Kinematics(model), step_client)
        view = checker.view(scene)
        Q = _uniform(model, 6_000, seed=1)
        Q = Q[view.valid(Q)]
        free = np.array([q for q in Q if not published.collides([*q, *published.fingers])])
        yield Setup(view, published, free)


@pytest.mark.parametrize("size", SIZES)
def test_a_verdict(benchmark, setup, size):
    rng = np.random.default_rng(size)
    batch = lambda: ((setup.batch(rng, size),), {})  # noqa: E731  # short
    assert benchmark.pedantic(setup.view.valid, setup=batch, rounds=ROUNDS, warmup_rounds=3).all()


def test_the_published_verdict(benchmark, setup):
    rng = np.random.default_rng(0)
    one = lambda: ((setup.padded(setup.batch(rng, 1)[0]),), {})  # noqa: E731  # short
    assert not benchmark.pedantic(setup.published.collides, setup=one, rounds=ROUNDS, warmup_rounds=3)


def test_ratios(setup, request, capsys):
    rng = np.random.default_rng(3)
    times: dict[int, list[float]] = {size: [] for size in (0, *SIZES)}
    for _ in range(TURNS):
        for size, found in times.items():
            batches = [setup.batch(rng, size or 1) for _ in range(CALLS)]
            asked = batches if size else [setup.padded(batch[0]) for batch in batches]
            answer = setup.view.valid if size else setup.published.collides
            for i, question in enumerate(asked):
                began = process_time()
                answer(question)
                took = process_time() - began
                if i >= CALLS // 3:
                    found.append(1e6 * took / (size or 1))
    published = np.median(times.pop(0))
    lines = [f"| {request.node.callspec.id} | µs a verdict | ratio | mean ratio |", "|---|---|---|---|"]
    lines.append(f"| pybullet-planning | {published:.0f} | 1 | 1 |")
    for size, found in times.items():
        median, mean = np.median(found), np.mean(found)
        lines.append(f"| batches of {size} | {median:.1f} | {published / median:.1f} | {published / mean:.1f} |")
    with capsys.disabled():
        print("\n" + "\n".join(lines))  # noqa: T201  # it is the result


def test_the_verdicts_are_the_same_where_both_test_the_same_links(setup, capsys):
    """The base link is the exception: pybullet-planning tests no pair that it is part of."""
    view, base = setup.view, RobotModel(panda()).links[0]
    Q = _uniform(RobotModel(panda()), COUNT, seed=2)
    ours = view.valid(Q)
    theirs = np.array([not setup.published.collides(setup.padded(q)) for q in Q])
    exceptions: Counter[str] = Counter()
    unexplained = []
    for q, free in zip(Q[ours != theirs], ours[ours != theirs], strict=True):
        contacts = view.contacts(q, SHALLOW if free else 0.0)
        if all(base in (contact.link, contact.other_link) for contact in contacts) and not free:
            exceptions[f"only {base} is touched, which pybullet-planning does not test"] += 1
        elif contacts and contacts[0].depth < SHALLOW:
            exceptions["the deepest contact is shallower than the hull's margin"] += 1
        else:
            unexplained.append((q.tolist(), bool(free), contacts))
    with capsys.disabled():
        print(f"\n{COUNT} configurations, {int(ours.sum())} free; different verdicts: {dict(exceptions)}")  # noqa: T201  # it is the result
    assert unexplained == []


def _uniform(model: RobotModel, count: int, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).uniform(model.low, model.high, (count, model.dof))


def _with_held(scene: Scene, name: str) -> Scene:
    """The scene with a box taken out of it and held by its middle, from above."""
    (box,) = (box for box in scene.boxes if box.name == name)
    held = HeldBox(name, box.size, Pose((0.0, 0.0, 0.012), (1.0, 0.0, 0.0, 0.0)))
    return Scene(tuple(other for other in scene.boxes if other.name != name), held, box.size[1])
