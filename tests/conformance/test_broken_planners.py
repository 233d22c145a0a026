"""The kit finds each fault that is planted in a motion planner, and says what it is and what may be the cause."""

from __future__ import annotations

import signal
import threading

import pytest
from broken_planners import BUDGET, FAULTS, ByTheWay, a_planner, idle

from llm3.testing import check_planner
from llm3.testing.conformance.planner import examine_planner


def test_a_planner_without_a_fault_has_no_complaint():
    assert check_planner(ByTheWay(), max_iterations=BUDGET) == ()


@pytest.mark.parametrize("fault", FAULTS)
def test_each_fault_is_found_and_named(fault):
    planted = FAULTS[fault]
    complaints = check_planner(planted.plugin, max_iterations=BUDGET)
    assert planted.found_in(complaints), "\n".join(f"{c.rule}: {c}" for c in complaints)


def test_a_planner_that_goes_on_and_asks_about_nothing_is_ended():
    alarm = signal.getsignal(signal.SIGALRM)
    (complaint,) = check_planner(a_planner(plan=idle), patience=0.1)
    assert (complaint.rule, complaint.text) == ("every query ends", "free: the planner does not end within 0.1 s.")
    assert signal.getsignal(signal.SIGALRM) is alarm
    assert signal.getitimer(signal.ITIMER_REAL) == (0.0, 0.0)


def test_an_alarm_that_is_not_the_kits_is_left_alone_and_so_is_another_thread():
    reports = []
    thread = threading.Thread(target=lambda: reports.append(examine_planner(ByTheWay())))
    thread.start()
    thread.join()
    signal.setitimer(signal.ITIMER_REAL, 600.0)
    try:
        reports.append(examine_planner(ByTheWay()))
        assert signal.getitimer(signal.ITIMER_REAL)[0] > 0
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
    said = "There was no alarm to be had, so a query that does not end would not have been ended."
    assert [(report.complaints, said in report.remarks) for report in reports] == [((), True)] * 2
    assert said not in examine_planner(ByTheWay()).remarks


def test_what_has_one_cause_is_told_once():
    complaints = check_planner(a_planner(plan=lambda self, problem, rng: None), max_iterations=BUDGET)
    assert [complaint.text for complaint in complaints] == ["free: plan answers None."]
