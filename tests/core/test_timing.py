"""Times for the plan that was found: where they come from, and where they are left out."""

from dataclasses import replace

import numpy as np
import pytest
from line_world import FINISH, Detour, Line, LineInstance, TickingClock, go, line_registry, play, reply, take

from llm3 import Joint, Registry, TrajectoryTimer, hookimpl
from llm3.assembly import RunConfig, assemble
from llm3.errors import PluginError, UnknownName
from llm3.records import Recorder, read_plan
from llm3.testing import ScriptedLLM
from llm3.timing import timed, unknown_limits
from llm3.types import RunEnded, Trajectory

WHEEL = Joint("wheel", "m", max_velocity=0.5, max_acceleration=2.0)
SOLVES = reply(go(1), take("coin"), go(FINISH))


class Pace(TrajectoryTimer):
    """A second for every waypoint, with a stop at each."""

    def __init__(self):
        self.asked = []

    def time(self, waypoints, max_velocity, max_acceleration):
        self.asked.append((max_velocity.tolist(), max_acceleration.tolist()))
        rows = tuple(map(tuple, waypoints.tolist()))
        return Trajectory(tuple(map(float, range(len(rows)))), rows, ((0.0,),) * len(rows))


class QuickLine(Line):
    """The line, with a wheel whose limits are known."""

    joints = (WHEEL,)


def untimed(plan):
    """The plan without its trajectories."""

    def segments(motion):
        return tuple(replace(segment, trajectory=None) for segment in motion.segments)

    return tuple(replace(step, motion=replace(step.motion, segments=segments(step.motion))) for step in plan)


def test_every_segment_of_the_plan_has_a_trajectory_and_nothing_else_is_changed():
    timer = Pace()
    plain, result = (play(SOLVES, env=QuickLine(), timer=t) for t in (None, timer))
    assert untimed(result.plan) == plain.plan
    first, coin, last = (step.motion for step in result.plan)
    for motion in (first, last):
        (segment,) = motion.segments
        assert segment.trajectory.positions == segment.waypoints
        assert motion.duration == 2.0
    assert coin.segments == ()
    assert timer.asked == [([0.5], [2.0])] * 2


def test_attempts_that_fail_are_not_timed():
    timer = Pace()
    assert not play(reply(go(1)), env=QuickLine(), timer=timer).solved
    assert timer.asked == []


def test_an_observer_is_told_of_the_plan_with_its_times():
    told = []
    result = play(SOLVES, env=QuickLine(), timer=Pace(), observer=told.append)
    (ended,) = (event for event in told if isinstance(event, RunEnded))
    assert ended.result is result
    assert result.plan[0].motion.duration == 2.0


def test_what_it_took_is_told():
    result = play(SOLVES, env=QuickLine(), timer=Pace(), clock=TickingClock())
    assert result.stats.seconds["timing"] == 1.0


@pytest.mark.parametrize(
    ("joints", "words"),
    [
        ((), "the domain names no joints"),
        ((WHEEL,), ""),
        ((WHEEL, Joint("lift", "m")), "the domain gives no max_velocity of lift and no max_acceleration of lift"),
        (
            (Joint("a", max_velocity=1.0), WHEEL, Joint("b", max_velocity=2.0)),
            "the domain gives no max_acceleration of a, b",
        ),
    ],
)
def test_without_all_limits_a_plan_has_no_times_and_it_is_said_which_are_missing(joints, words):
    assert unknown_limits(joints) == words
    plan = play(SOLVES).plan
    if words:
        assert timed(plan, Pace(), joints) == plan


class WrongEnd(Pace):
    def time(self, waypoints, max_velocity, max_acceleration):
        return super().time(waypoints[:-1], max_velocity, max_acceleration)


class Broken(TrajectoryTimer):
    def time(self, waypoints, max_velocity, max_acceleration):
        return np.zeros(3)


@pytest.mark.parametrize(
    ("timer", "sentence"),
    [
        (WrongEnd(), "WrongEnd.time must answer a trajectory from the first waypoint to the last."),
        (Broken(), "Broken.time must answer Trajectory, not ndarray."),
    ],
)
def test_a_timer_that_answers_something_else_is_a_broken_plugin(timer, sentence):
    with pytest.raises(PluginError) as caught:
        play(SOLVES, env=QuickLine(), timer=timer)
    assert str(caught.value) == sentence


# ---- by name -------------------------------------------------------------------------------------------------------


class PacePlugin:
    @hookimpl
    def llm3_timers(self):
        return {"toppra": Pace, "pace": Pace}


def registry_with_timers() -> Registry:
    registry = line_registry()
    registry.register(PacePlugin(), "pace (test)")
    return registry


def run_of(registry, **changes):
    run = assemble(registry, RunConfig("full-line", llm="random", **changes), LineInstance(0.0))
    return replace(run, problem=replace(run.problem, env=QuickLine()), planner=Detour())


@pytest.mark.parametrize(
    ("asked", "used"), [(None, "toppra"), ("pace", "pace"), ("none", "none")], ids=["nothing", "a name", "none"]
)
def test_the_usual_timer_is_used_unless_another_is_asked_for(asked, used):
    run = run_of(registry_with_timers(), timing=asked)
    assert (run.config.timing, run.timer is None) == (used, used == "none")


def test_where_the_usual_timer_is_not_there_a_plan_has_no_times():
    run = run_of(line_registry())
    assert (run.config.timing, run.timer) == ("none", None)


def test_a_timer_that_is_asked_for_has_to_be_there():
    with pytest.raises(UnknownName) as caught:
        run_of(registry_with_timers(), timing="place")
    assert str(caught.value) == "unknown timer 'place'; did you mean 'pace'? Known: none, pace, toppra."


def test_the_plan_on_disk_has_the_times(tmp_path):
    texts = set()
    for name, timing in (("a", None), ("b", None), ("c", "none")):
        run = run_of(registry_with_timers(), timing=timing)
        run = replace(run, solver=replace(run.solver, backend=ScriptedLLM([SOLVES])))
        folder = tmp_path / name
        folder.mkdir()
        with Recorder(folder, run, TickingClock()) as recorder:
            result = run.solve(recorder)
        found = read_plan(folder)
        assert found.joints == (WHEEL,)
        assert found.actions == result.plan
        assert found.actions[0].motion.duration == (2.0 if timing is None else None)
        texts.add((folder / "plan.json").read_text(encoding="utf-8"))
    assert len(texts) == 2  # a and b are the same to the byte
