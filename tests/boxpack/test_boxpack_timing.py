"""A packing run whose plan has times: within the robot's limits, and near the path that was checked."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from llm3.records import PlanFile
from llm3.types import Motion, Segment

CONTROLLER = 1e-3
"""Seconds: the cycle in which a Panda is told where to be."""


@pytest.fixture(scope="module", params=["panda", "iiwa"])
def plan(request, solve) -> PlanFile:
    result, plan = solve(setting="medium-small", seed=1, timing="toppra", options={"robot": request.param})
    assert result.solved
    return plan


def segments(plan: PlanFile) -> list[Segment]:
    return [segment for step in plan.actions for segment in step.motion.segments]


def test_every_segment_has_times_from_standstill_to_standstill(plan):
    for segment in segments(plan):
        assert segment.trajectory.positions[0] == segment.waypoints[0]
        assert segment.trajectory.positions[-1] == segment.waypoints[-1]
        assert not any(segment.trajectory.velocities[0])
        assert not any(segment.trajectory.velocities[-1])


def test_the_limits_of_the_robot_are_kept(plan):
    max_velocity = [joint.max_velocity for joint in plan.joints]
    max_acceleration = [joint.max_acceleration for joint in plan.joints]
    for segment in segments(plan):
        times = np.arange(0.0, segment.trajectory.duration, CONTROLLER)
        _, velocities, accelerations = segment.trajectory.sample(times)
        assert (np.abs(velocities) <= max_velocity).all()
        assert (np.abs(accelerations) <= max_acceleration).all()


def test_the_path_is_kept(plan):
    for segment in segments(plan):
        points = segment.trajectory.sample(np.arange(0.0, segment.trajectory.duration, CONTROLLER))[0]
        assert np.min([_distances(points, a, b) for a, b in pairwise(segment.waypoints)], axis=0).max() <= 5.1e-4


def test_most_straight_lines_of_the_tool_are_one_motion_without_a_stop(plan):
    stops = [
        sum(not any(velocity) for velocity in segment.trajectory.velocities) - 2
        for segment in segments(plan)
        if segment.label != "transit"
    ]
    assert np.median(stops) == 0  # near a singularity joints turn so far that a curve would leave the path


def test_without_times_the_plan_is_the_same(plan, solve):
    _, plain = solve(setting="medium-small", seed=1, timing="none", options=plan.options)
    assert [step.motion.duration for step in plain.actions] == [None] * len(plan.actions)
    assert replace(plan, actions=tuple(replace(step, motion=_plain(step.motion)) for step in plan.actions)) == plain


def _distances(points, start, end):
    begin, way = np.array(start), np.subtract(end, start)
    fraction = np.clip((points - begin) @ way / max(way @ way, 1e-300), 0.0, 1.0)
    return np.linalg.norm(points - begin - fraction[:, None] * way, axis=1)


def _plain(motion: Motion) -> Motion:
    return Motion(tuple(replace(segment, trajectory=None) for segment in motion.segments))
