"""How long inverse kinematics takes, beside PyBullet's own with restarts.

    OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 pytest tests/benchmarks/test_inverse.py --benchmark-columns=median,iqr

The targets are top grasps in the baskets of the nine settings, by the verdicts of tests/oracles. Each row's name ends
in the share of its targets that were solved. PyBullet's solver, in C++, is given ten starts, the first of them home and
the others random, of up to 100 steps each and a hundredfold tolerance. It is checked by forward kinematics, and against
the joint limits, which it does not keep. It ends with its first solution, where llm3 returns several. Its default
damping is too strong to converge in so few steps, so a row shows it with 0.01 as well.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from itertools import cycle
from pathlib import Path

import numpy as np
import pytest

from llm3_bullet.clients import BulletClient, connect, quiet
from llm3_bullet.inverse import InverseKinematics
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.mounting import urdf_file
from llm3_bullet.robots import panda

VERDICTS = Path(__file__).parents[1] / "oracles" / "panda_top_grasps.json"
COUNT = 200
STARTS, STEPS = 10, 100
METRES, RADIANS = 1e-3, 1e-2

Solve = Callable[[np.ndarray], bool]


def targets(reached: bool) -> list[np.ndarray]:
    """Tool poses (4, 4) in the baskets, in random order."""
    poses = []
    for stratum, x, y, z, yaw, verdict, *_ in json.loads(VERDICTS.read_text())["verdicts"]:
        if stratum.startswith("basket") and verdict == reached:
            cosine, sine = np.cos(yaw), np.sin(yaw)
            poses.append(np.array([[cosine, sine, 0, x], [sine, -cosine, 0, y], [0, 0, -1, z], [0, 0, 0, 1]]))
    order = np.random.default_rng(0).permutation(len(poses))[:COUNT]
    return [poses[k] for k in order]


@pytest.fixture(scope="module")
def model() -> RobotModel:
    return RobotModel(panda())


def ours(model: RobotModel) -> Solve:
    inverse, rng = InverseKinematics(Kinematics(model)), np.random.default_rng(0)
    return lambda target: inverse.solve(target, rng).reached


def pybullets(model: RobotModel, client: BulletClient, **settings: object) -> Solve:
    with urdf_file(model.description) as file, quiet():
        body = client.loadURDF(str(file), useFixedBase=True)
    rng, link = np.random.default_rng(0), model.tool - 1

    def move(q: np.ndarray) -> None:
        for joint, position in zip(model.arm_joints, q, strict=True):
            client.resetJointState(body, joint, position)

    def solve(target: np.ndarray) -> bool:
        position, turn = target[:3, 3].tolist(), quaternion(target)
        for start in (model.home, *rng.uniform(model.low, model.high, (STARTS - 1, model.dof))):
            move(start)
            found = client.calculateInverseKinematics(
                body, link, position, turn, maxNumIterations=STEPS, residualThreshold=1e-5, **settings
            )
            q = np.array(found[: model.dof])
            move(q)
            state = client.getLinkState(body, link, computeForwardKinematics=True)
            away = np.linalg.norm(np.subtract(state[4], position))
            turned = 2 * np.arccos(min(1.0, abs(np.dot(state[5], turn))))
            if model.within_limits(q[None])[0] and away <= METRES and turned <= RADIANS:
                return True
        return False

    return solve


def quaternion(target: np.ndarray) -> list[float]:
    """Of a tool that points down: half a turn about the horizontal axis halfway between the two x axes."""
    half = np.arctan2(target[1, 0], target[0, 0]) / 2
    return [float(np.cos(half)), float(np.sin(half)), 0.0, 0.0]


@pytest.mark.parametrize("reached", [True, False], ids=["reachable", "out of reach"])
@pytest.mark.parametrize("method", ["llm3", "PyBullet", "PyBullet damped by 0.01"])
def test_inverse_kinematics(benchmark, model: RobotModel, method: str, reached: bool) -> None:
    poses = targets(reached)
    with connect() as client:
        damping = {"jointDamping": [0.01] * (model.dof + len(model.finger_joints))} if "damped" in method else {}
        solve = ours(model) if method == "llm3" else pybullets(model, client, **damping)
        solved = sum(map(solve, poses)) / len(poses)
        benchmark.group = "reachable" if reached else "out of reach"
        benchmark.name = f"{method}: {solved:.1%} solved"
        benchmark.extra_info["solved"] = solved
        turn = cycle(poses)
        benchmark.pedantic(solve, setup=lambda: ((next(turn),), {}), rounds=len(poses))
