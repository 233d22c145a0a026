"""Which top grasps an arm reaches: writes the verdicts that the tests of inverse kinematics are held against.

    OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 python tests/oracles/reach_oracle.py [--robot panda] [--write] [--scale 1]

A target is called reached when an attempt of `reach_solver` met it, and that attempt is kept as the witness; it is
called unreached after hundreds of random starts have failed, and after thousands where the best of them came close.
Targets are drawn by strata; all of it follows from the seed. Without `--write` it prints the counts only, and
`--scale 10` draws ten times as many.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from reach_solver import REACHED, Chain, best_attempts, read_chain

from llm3.seeding import generator
from llm3_boxpack.paper_settings import BASKETS, BOX_SETS, START_X, START_Y

HERE = Path(__file__).parent
STARTS = ((16, 40, np.inf), (256, 60, np.inf), (2048, 100, 0.03))
"""Rounds for what is still unreached: starts, steps, and the best residual from which a round is spared."""
BATCH = 64
HEIGHTS = (0.02, 0.2)
"""Metres: from the lowest box's middle to the third box of a stack."""
COUNTS = {"panda": 100, "iiwa": 10}
"""Targets of the smallest stratum."""


@dataclass(frozen=True)
class Verdict:
    """What the oracle says of one top grasp: the tool's z axis points down, and its x axis along `yaw`."""

    stratum: str
    x: float
    y: float
    z: float
    yaw: float
    reached: bool
    position_error: float
    """Of the best attempt, in metres."""
    rotation_error: float
    """In radians."""
    witness: tuple[float, ...]
    """The configuration that reached it, rounded to a millionth of a radian; empty if none did."""


def chain(robot: str) -> Chain:
    """The arm, from the model files and the makers' limits."""
    data = Path(find_spec("pybullet_data").origin).parent
    if robot == "iiwa":  # on its pedestal, with flange, plate, tube and cup
        beyond = 0.045 + 0.01 + 0.1 + 0.02
        return read_chain(data / "kuka_iiwa" / "model.urdf", "lbr_iiwa_link_7", base=0.2, beyond=beyond)
    low = (-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973)
    high = (2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973)
    limits = {f"panda_joint{j}": pair for j, pair in enumerate(zip(low, high, strict=True), 1)}
    return read_chain(data / "franka_panda" / "panda.urdf", "panda_grasptarget", limits=limits)


def strata(count: int, rng: np.random.Generator) -> Iterator[tuple[str, np.ndarray]]:
    """Names, and x, y, z and yaw of the targets, (n, 4), on the grid of states: 0.1 mm and 0.0001 rad."""

    def turned(*columns):
        return np.round(np.column_stack([*columns, rng.uniform(-np.pi, np.pi, len(columns[0]))]), 4)

    def around(radius, height, n):
        r, z = rng.uniform(*radius, n), rng.uniform(*height, n)
        azimuth = rng.uniform(-np.pi, np.pi, n)
        return turned(r * np.cos(azimuth), r * np.sin(azimuth), z)

    for boxes in BOX_SETS:
        for name, basket in BASKETS.items():
            (x, y), (dx, dy) = basket.center, basket.size
            n = 3 * count
            across = rng.uniform(-0.5, 0.5, (n, 2)) * (dx, dy) + (x, y)
            yield f"basket {boxes}-{name}", turned(*across.T, rng.uniform(*HEIGHTS, n))
        lanes = rng.uniform(*START_X, count), rng.uniform(*START_Y, count), rng.uniform(*HEIGHTS, count)
        yield f"pick {boxes}", turned(*lanes)
    for inner in (0.75, 0.775, 0.8, 0.825, 0.85, 0.875):
        yield f"radius {inner:.3f}", around((inner, inner + 0.025), (0.0, 0.4), 2 * count)
    yield "near the base", around((0.05, 0.35), (-0.1, 0.6), 3 * count)
    yield "low", around((0.3, 0.85), (-0.3, 0.0), count)
    yield "high", around((0.2, 0.85), (0.4, 0.9), 3 * count)


def top_grasps(xyz_yaw: np.ndarray) -> np.ndarray:
    """Tool poses (n, 4, 4) of targets (n, 4): x, y, z in metres and yaw in radians."""
    poses = np.zeros((len(xyz_yaw), 4, 4))
    cosine, sine = np.cos(xyz_yaw[:, 3]), np.sin(xyz_yaw[:, 3])
    poses[:, 0, 0], poses[:, 1, 0], poses[:, 0, 1], poses[:, 1, 1] = cosine, sine, sine, -cosine
    poses[:, 2, 2], poses[:, 3, 3], poses[:, :3, 3] = -1.0, 1.0, xyz_yaw[:, :3]
    return poses


def judge(arm: Chain, xyz_yaw: np.ndarray, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """The best attempts for targets (n, 4): configurations (n, dof) and shortfalls (n, 2)."""
    poses = top_grasps(xyz_yaw)
    Q, short = np.zeros((len(poses), len(arm.low))), np.full((len(poses), 2), np.inf)
    for starts, steps, near in STARTS:
        open_ = np.flatnonzero((short > REACHED).any(axis=1) & ~(np.hypot(*short.T) > near))
        for some in np.array_split(open_, -(-len(open_) * starts // (BATCH * 256)) or 1):
            tried, left = best_attempts(arm, poses[some], starts, steps, rng)
            better = np.hypot(*left.T) < np.hypot(*short[some].T)
            Q[some[better]], short[some[better]] = tried[better], left[better]
    return Q, short


def verdicts(robot: str, scale: float = 1.0, seed: int = 0) -> Iterator[Verdict]:
    """All targets with what is said of them."""
    arm = chain(robot)
    rng = generator("reach oracle", robot, seed)
    for name, xyz_yaw in strata(round(scale * COUNTS[robot]), rng):
        Q, short = judge(arm, xyz_yaw, rng)
        for target, q, errors in zip(xyz_yaw.tolist(), Q, short, strict=True):
            reached = bool((errors <= REACHED).all())
            position, rotation = (0.0, 0.0) if reached else (float(f"{e:.3g}") for e in errors)
            witness = tuple(np.round(q, 6).tolist()) if reached else ()
            yield Verdict(name, *target, reached, position, rotation, witness)


def read(robot: str) -> list[Verdict]:
    """The committed verdicts."""
    rows = json.loads((HERE / f"{robot}_top_grasps.json").read_text())["verdicts"]
    return [Verdict(*row[:8], tuple(row[8])) for row in rows]


def write(robot: str, found: list[Verdict]) -> None:
    """Replace the committed verdicts: one line each, in the order of `Verdict`'s fields."""
    lines = ",\n".join(json.dumps(list(vars(verdict).values())) for verdict in found)
    (HERE / f"{robot}_top_grasps.json").write_text(f'{{"robot": "{robot}", "verdicts": [\n{lines}\n]}}\n')


def main() -> None:
    """Draw, judge, count, and write if asked to."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--robot", choices=sorted(COUNTS), default="panda")
    parser.add_argument("--scale", type=float, default=1.0, help="times as many targets (default: 1)")
    parser.add_argument("--seed", type=int, default=0, help="another sample (default: 0, the committed one)")
    parser.add_argument("--write", action="store_true", help="replace the committed verdicts")
    arguments = parser.parse_args()
    found = list(verdicts(arguments.robot, arguments.scale, arguments.seed))
    for name in dict.fromkeys(verdict.stratum for verdict in found):
        of_stratum = [verdict.reached for verdict in found if verdict.stratum == name]
        sys.stdout.write(f"{name:22} {sum(of_stratum):5} reached, {len(of_stratum) - sum(of_stratum):5} not\n")
    reached = sum(verdict.reached for verdict in found)
    sys.stdout.write(f"{'all':22} {reached:5} reached, {len(found) - reached:5} not\n")
    if arguments.write:
        write(arguments.robot, found)


if __name__ == "__main__":
    main()
