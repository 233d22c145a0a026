"""Inverse kinematics reaches what an independent solver with very many random starts reaches, and nothing else.

The solver's verdicts are committed (`reach_oracle`); they are checked here, too.
"""

from __future__ import annotations

import numpy as np
import pytest
from bullet_tool import tool_poses
from reach_oracle import REACHED, chain, judge, read, strata, top_grasps

from llm3_bullet.arm_length import ArmLength
from llm3_bullet.descent import POSITION_TOLERANCE, ROTATION_TOLERANCE
from llm3_bullet.inverse import InverseKinematics
from llm3_bullet.kinematics import Kinematics
from llm3_bullet.model import RobotModel
from llm3_bullet.robots import find_robot

pytestmark = pytest.mark.pybullet

ROBOTS = ("panda", "iiwa")
EVERY = 12  # in the fast suite
TOLERANCE = np.array((POSITION_TOLERANCE, ROTATION_TOLERANCE))
SINGLE_PRECISION = np.array((5e-6, 2e-5))  # metres and radians


@pytest.fixture(scope="module", params=ROBOTS)
def robot(request):
    return request.param


@pytest.fixture(scope="module")
def verdicts(robot):
    return read(robot)


@pytest.fixture(scope="module")
def arm(robot):
    return Kinematics(RobotModel(find_robot(robot)))


@pytest.fixture(scope="module")
def inverse(arm):
    return InverseKinematics(arm)


@pytest.fixture(scope="module")
def pybullets_tool(arm):
    with tool_poses(arm.model) as tool:
        yield tool


def targets(verdicts):
    return np.array([(v.x, v.y, v.z, v.yaw) for v in verdicts])


def of_a_setting(stratum):
    return stratum.startswith(("basket", "pick"))


def distances(poses, wanted):
    """Metres and radians between poses (N, 4, 4), by their matrices: (N, 2)."""
    chords = np.linalg.norm((poses - wanted)[:, :3, :3], axis=(1, 2)) / np.sqrt(8)
    return np.column_stack([np.linalg.norm((poses - wanted)[:, :3, 3], axis=1), 2 * np.arcsin(chords)])


def assert_as_the_oracle_says(inverse, verdicts):
    """One by one, as a run asks."""
    rng = np.random.default_rng(0)
    results = [inverse.solve(pose, rng) for pose in top_grasps(targets(verdicts))]
    missed = [v for v, r in zip(verdicts, results, strict=True) if v.reached and not r.reached]
    assert not [v for v in missed if of_a_setting(v.stratum)]
    assert len(missed) <= 0.001 * sum(v.reached for v in verdicts)
    out_of_reach = [(v, r) for v, r in zip(verdicts, results, strict=True) if not v.reached]
    assert not [v for v, r in out_of_reach if r.reached]
    ours = np.array([np.hypot(r.position_error, r.rotation_error) for _, r in out_of_reach])
    best = np.array([np.hypot(v.position_error, v.rotation_error) for v, _ in out_of_reach])
    assert (ours <= best + 0.005).all()
    assert (ours >= 0.99 * best - 1e-5).all()


def test_a_sample_is_judged_as_the_oracle_does(inverse, verdicts):
    assert_as_the_oracle_says(inverse, verdicts[::EVERY])


@pytest.mark.slow
def test_all_is_judged_as_the_oracle_does(inverse, verdicts):
    assert_as_the_oracle_says(inverse, verdicts)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("robot", "count", "reachable"), [("panda", 1000, 25_000), ("iiwa", 100, 2_400)], indirect=["robot"]
)
def test_of_fresh_targets_of_the_nine_settings_none_in_reach_is_missed(robot, count, reachable, arm, inverse):
    """Only those need a verdict of the oracle that are called unreachable although the arm may be long enough."""
    drawn = np.vstack([xyz_yaw for name, xyz_yaw in strata(count, np.random.default_rng(77)) if of_a_setting(name)])
    poses, rng = top_grasps(drawn), np.random.default_rng(0)
    results = [r for some in np.array_split(poses, len(poses) // 32) for r in inverse.solve_many(some, rng)]
    reached = np.array([result.reached for result in results])
    proved = ArmLength(arm).too_short(poses, POSITION_TOLERANCE, ROTATION_TOLERANCE)
    assert not (reached & proved).any()
    _, short = judge(chain(robot), drawn[~reached & ~proved], rng)
    assert not (short <= REACHED).all(axis=1).any()
    assert reached.sum() >= reachable


def test_solutions_are_within_the_limits_and_meet_their_targets_as_pybullet_sees_them(
    robot, inverse, verdicts, pybullets_tool
):
    own = chain(robot)  # with limits that were written down independently
    sample = verdicts[:: 4 * EVERY]
    several = 0
    for pose, result in zip(
        top_grasps(targets(sample)),
        inverse.solve_many(top_grasps(targets(sample)), np.random.default_rng(0)),
        strict=True,
    ):
        solutions = result.solutions
        assert ((own.low - 1e-9 <= solutions) & (solutions <= own.high + 1e-9)).all()
        assert (distances(pybullets_tool(solutions), pose) <= TOLERANCE + SINGLE_PRECISION).all()
        several += len(solutions) > 1
    assert several >= 0.9 * sum(v.reached for v in sample)


def test_the_oracles_witnesses_reach_their_targets_as_pybullet_sees_them(robot, verdicts, pybullets_tool):
    own = chain(robot)
    reached = [v for v in verdicts if v.reached]
    witnesses = np.array([v.witness for v in reached])
    assert ((own.low - 1e-6 <= witnesses) & (witnesses <= own.high + 1e-6)).all()
    assert (distances(pybullets_tool(witnesses), top_grasps(targets(reached))) <= SINGLE_PRECISION).all()


@pytest.mark.parametrize(("name", "reached", "unreached"), [("panda", 3000, 1000), ("iiwa", 300, 100)])
def test_the_oracle_has_judged_enough(name, reached, unreached):
    found = [v.reached for v in read(name)]
    assert sum(found) >= reached
    assert len(found) - sum(found) >= unreached


@pytest.mark.slow
def test_the_oracle_comes_to_the_same_verdicts_again(robot, verdicts):
    rng = np.random.default_rng(1)
    sample = [verdicts[k] for k in rng.choice(len(verdicts), 200 if robot == "panda" else 50, replace=False)]
    _, short = judge(chain(robot), targets(sample), rng)
    assert (short <= REACHED).all(axis=1).tolist() == [v.reached for v in sample]
    left = np.array([(v.position_error, v.rotation_error) for v in sample])
    np.testing.assert_allclose(np.hypot(*short.T), np.hypot(*left.T), atol=0.002)
