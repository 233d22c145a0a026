"""A run is shown while it happens, and nothing that is known is played twice."""

from __future__ import annotations

import pytest
from test_frames import GRASP, HERE, PLAN, START, TAKEN, THERE

from llm3.errors import MissingCapability, PluginError
from llm3.interfaces import Stage
from llm3.playback import Live, frames, open_window
from llm3.playback.live import LAST_LOOK, RATE
from llm3.types import (
    ActionTried,
    Failure,
    FailureKind,
    Held,
    Outcome,
    RunStarted,
    moment_of,
)

TAKE = PLAN[0]


class Notes(Stage):
    """Remembers what it is shown."""

    def __init__(self):
        self.shown, self.closed = [], 0

    def show(self, moment):
        self.shown.append(moment)

    def picture(self, width, height):
        raise NotImplementedError

    def close(self):
        self.closed += 1


@pytest.fixture
def stage():
    return Notes()


@pytest.fixture
def waits():
    return []


@pytest.fixture
def live(stage, waits):
    return Live(stage, waits.append)


def tried(outcome, step=None, before=START):
    return ActionTried(1, 0, before, outcome, step)


def test_the_initial_state_is_shown(live, stage):
    live(RunStarted(START))
    assert stage.shown == [moment_of(START)]


def test_what_is_carried_out_is_played_in_its_time(live, stage, waits):
    live(tried(Outcome(TAKE.action), TAKE))
    assert stage.shown == [frame.moment for frame in frames(START, (TAKE,), RATE)]
    assert sum(waits) == pytest.approx(stage.shown[-1].time)


def test_of_what_is_known_only_the_end_is_shown(live, stage, waits):
    live(tried(Outcome(TAKE.action, reused=True), TAKE))
    assert (stage.shown, waits) == ([moment_of(TAKEN)], [])


def test_where_an_action_fails_the_state_before_it_is_shown(live, stage):
    live(tried(Outcome(TAKE.action, Failure(FailureKind.NO_PATH)), before=TAKEN))
    assert stage.shown == [moment_of(TAKEN)]
    assert TAKEN.held == Held("cup", GRASP)
    assert START.poses == {"cup": HERE, "pot": THERE}


def test_the_end_is_left_for_a_last_look(live, stage, waits):
    with live:
        pass
    assert (waits, stage.closed) == ([LAST_LOOK], 1)


def test_after_an_error_nobody_waits(live, stage, waits):
    with pytest.raises(ZeroDivisionError), live:
        raise ZeroDivisionError
    assert (waits, stage.closed) == ([], 1)


# ---- windows -------------------------------------------------------------------------------------------------------


class Windowed:
    """What is asked of a domain."""

    name = "windowed"

    def __init__(self, made):
        self.made, self.asked = made, []

    def stage(self, instance, options, window=False):
        self.asked.append((instance, options, window))
        return self.made


def test_a_window_is_the_domains(stage):
    domain = Windowed(stage)
    assert open_window(domain, 7, {"a": "b"}) is stage
    assert domain.asked == [(7, {"a": "b"}, True)]


def test_a_window_needs_a_domain_that_has_one():
    with pytest.raises(MissingCapability) as error:
        open_window(Windowed(None), 7, {})
    assert str(error.value) == "domain 'windowed' has no window, which --gui needs."


def test_what_is_no_stage_is_the_domains_mistake():
    with pytest.raises(PluginError) as error:
        open_window(Windowed("here"), 7, {})
    assert str(error.value) == "Windowed.stage must answer Stage or NoneType, not str."
