"""toppra: missing, silent, and without what it would like to draw."""

from __future__ import annotations

import sys

import pytest
from command_line import environment, run

import llm3_time.plugin
from llm3 import Registry
from llm3.assembly import choose_timer
from llm3.errors import MissingDependency, UnknownName

CURVE = """
import sys
import numpy as np
from llm3_time.plugin import llm3_timers
timer = llm3_timers()["toppra"]()
angles = np.linspace(0.0, 0.5, 11)
timer.time(np.column_stack([np.cos(angles), np.sin(angles)]), np.ones(2), np.ones(2))
assert "toppra" in sys.modules
"""


def registry() -> Registry:
    found = Registry()
    found.register(llm3_time.plugin, "time (test)")
    return found


def isolated(code: str, home) -> None:
    ended = run([sys.executable, "-W", "error", "-c", code], home, environment(HOME=str(home), MPLCONFIGDIR=""))
    assert (ended.code, ended.out, ended.err) == (0, "", "")


def test_a_missing_package_is_one_line_that_says_what_to_install(monkeypatch):
    monkeypatch.setattr("llm3_time.plugin.find_spec", lambda name: None)
    with pytest.raises(MissingDependency) as caught:
        registry().timer("toppra")
    assert str(caught.value) == ("the timer 'toppra' needs a package that is not installed: pip install 'llm3[time]'.")


def test_nobody_who_does_not_ask_for_it_hears_of_a_missing_package(monkeypatch):
    assert choose_timer(registry(), None) is not None
    assert choose_timer(registry(), "none") is None
    assert choose_timer(Registry(), None) is None
    monkeypatch.setattr("llm3_time.plugin.find_spec", lambda name: None)
    assert choose_timer(registry(), None) is None


def test_an_unknown_timer_is_named_with_the_known_ones():
    with pytest.raises(UnknownName) as caught:
        choose_timer(registry(), "topra")
    assert str(caught.value) == "unknown timer 'topra'; did you mean 'toppra'? Known: none, toppra."


def test_nothing_is_printed_and_nothing_is_written_to_the_users_home(tmp_path):
    isolated(CURVE + "assert 'matplotlib' not in sys.modules", tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_straight_edges_load_nothing(tmp_path):
    straight = CURVE.replace("0.5, 11)", "0.5, 2)").replace('"toppra" in', '"toppra" not in')
    isolated(straight, tmp_path)


@pytest.mark.slow
def test_whoever_draws_gets_the_real_matplotlib(tmp_path):
    draws = """
import matplotlib, toppra.algorithm.algorithm as drawing
assert matplotlib.__file__
matplotlib.use("agg")
assert drawing.plt.figure(num=3).number == 3
"""
    isolated(CURVE + draws, tmp_path)


@pytest.mark.slow
def test_whoever_has_matplotlib_keeps_it(tmp_path):
    isolated(
        "import matplotlib.pyplot as before\n" + CURVE + "assert sys.modules['matplotlib.pyplot'] is before", tmp_path
    )
