"""Plays the actions of a plan one after another, and tells what is wrong with them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from llm3.types import Event, EventKind, PlannedAction, Segment, State, Trajectory
from llm3_tabletop2d.verification.findings import Findings
from llm3_tabletop2d.verification.outlines import Array
from llm3_tabletop2d.verification.world import World

STEP = 0.002
"""Distance of the places that are looked at, in metres, at most."""
REACH = 0.002
"""What the robot takes hold of is this close to it, in metres, at most."""
SAME = 0.00021
"""Places that differ by less, in metres, are the same: states are rounded to 0.1 mm."""
PERIOD = 0.01
"""Times that are looked at, in seconds."""
EXCESS = 1.001
"""By this factor a trajectory may exceed the limits of the joints: rounding."""
OFF_LINE = 0.001
"""How far a trajectory may be from the line between its waypoints, in metres."""


class Playback:
    """A plan on its way through a world of its own."""

    def __init__(self, world: World, max_velocity: float, max_acceleration: float) -> None:
        """Take the world, and the limits of both joints, in m/s and m/s²."""
        self.world, self.findings = world, Findings()
        self._limits = (("speed", "m/s", max_velocity), ("acceleration", "m/s²", max_acceleration))
        self.taken: list[str] = []
        """What the last action took hold of."""
        self.let_go: list[str] = []
        """What it let go of."""
        self.behind = True
        """Whether the robot was behind what it held, all along the last action."""

    def play(self, step: PlannedAction) -> None:
        """Play the next action."""
        self.findings.begin_action(step)
        self.taken, self.let_go, self.behind = [], [], True
        for segment in step.motion.segments:
            self.findings.begin_segment(segment.label)
            self._play(segment)
        self.findings.begin_segment("")
        self._compare(step.state)

    def _play(self, segment: Segment) -> None:
        points = np.array(segment.waypoints)
        jump = float(np.linalg.norm(points[0] - self.world.at))
        if jump > SAME:
            self.findings.tell(f"the segment begins {jump * 1000:.1f} mm from where the robot is", jump=jump)
        self.world.at = points[0]
        for event in segment.events:
            self._carry_out(event)
        for index, (a, b) in enumerate(pairwise(points)):
            steps = max(1, int(np.ceil(min(float(np.linalg.norm(b - a)), 1e3) / STEP)))
            shares = np.linspace(0.0, 1.0, steps + 1)
            self.findings.see(self.world.depths(a + shares[:, None] * (b - a)), index + shares)
            if self.world.held and (self.world.centers[self.world.held] - self.world.at) @ (b - a) <= 0:
                self.behind = False
        if segment.trajectory:
            self._check_times(segment.trajectory, points)
        self.world.move(points[-1])

    def _carry_out(self, event: Event) -> None:
        name = event.object
        if name not in self.world.objects:
            self.findings.tell(f"nothing that can be moved is called {name!r}")
        elif event.kind is EventKind.ATTACH:
            if self.world.held:
                self.findings.tell(f"the robot takes hold of {name} while it holds {self.world.held}")
            gap = self.world.gap_to(name)
            if gap > REACH:
                self.findings.tell(f"the robot takes hold of {name} from {gap * 1000:.1f} mm away", gap=gap)
            self.world.held = name
            self.taken.append(name)
        elif event.kind is EventKind.DETACH:
            if self.world.held != name:
                self.findings.tell(f"the robot lets go of {name}, which it does not hold")
            self.world.held = None
            self.let_go.append(name)

    def _check_times(self, trajectory: Trajectory, points: Array) -> None:
        """Whether a trajectory is within the limits, touches nothing, and goes where the waypoints go."""
        count = int(np.ceil(min(trajectory.duration, 1e3) / PERIOD)) + 1
        times = np.unique(np.concatenate([np.linspace(0.0, trajectory.duration, count), trajectory.times]))
        positions, velocities, accelerations = trajectory.sample(times)
        for (what, unit, limit), values in zip(self._limits, (velocities, accelerations), strict=True):
            most = float(np.abs(values).max())
            if most > limit * EXCESS:
                self.findings.tell(f"the {what} reaches {most:.3f} {unit}, and the limit is {limit:g} {unit}")
        off = np.array([_distance(position, points) for position in positions])
        ends = np.abs(positions[[0, -1]] - points[[0, -1]]).max()
        if max(off.max(), ends) > OFF_LINE:
            worst = int(off.argmax())
            self.findings.tell("the trajectory is not where the waypoints are", time=float(times[worst]))
        self.findings.see(self.world.depths(positions), times, timed=True)

    def _compare(self, state: State) -> None:
        """Whether the plan says what happened."""
        if state.held is None and self.world.held is None:
            held = set()
        else:
            held = {self.world.held}
            if state.held is None or state.held.object != self.world.held:
                says = state.held.object if state.held else "nothing"
                self.findings.tell(f"the robot holds {self.world.held or 'nothing'}, and the plan says {says}")
        for name, center in self.world.centers.items():
            pose = state.poses.get(name)
            if name in held:
                continue
            if pose is None or np.linalg.norm(np.array(pose.position[:2]) - center) > SAME:
                x, y = center
                self.findings.tell(f"{name} is at ({x:.4f}, {y:.4f}), and the plan says otherwise")
        if np.linalg.norm(np.array(state.configuration) - self.world.at) > SAME:
            x, y = self.world.at
            self.findings.tell(f"the robot is at ({x:.4f}, {y:.4f}), and the plan says otherwise")


def _distance(point: Array, line: Array) -> float:
    """Of a point from a line of waypoints (N, 2), in metres."""
    if len(line) == 1:
        return float(np.linalg.norm(point - line[0]))
    a, way = line[:-1], np.diff(line, axis=0)
    share = np.clip(((point - a) * way).sum(axis=1) / np.maximum((way**2).sum(axis=1), 1e-12), 0.0, 1.0)
    return float(np.linalg.norm(a + share[:, None] * way - point, axis=1).min())
