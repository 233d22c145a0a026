"""The Env with a window behaves as the one without, and plays what it applies."""

from __future__ import annotations

import numpy as np
import pytest

from llm3.types import Action, Motion, Path
from llm3_boxpack.domain import BoxPack
from llm3_bullet.clients import connect
from llm3_bullet.tabletop import window
from llm3_bullet.tabletop.window import WindowEnv

PICK = Action("pick", ("red_box",))


@pytest.fixture
def instance():
    return BoxPack().instance("easy-small", 0)


def carried_out(env, state) -> Motion:
    """A motion that jumps to the first goal: enough to be applied and played."""
    problem = env.prepare(state, PICK, np.random.default_rng(0))
    return problem.motion(Path(np.array([problem.start, problem.goals[0].configuration])))


def test_it_gives_the_same_transitions_and_plays_them(instance, monkeypatch):
    monkeypatch.setattr(window, "LAST_LOOK", 0.0)
    waits: list[float] = []
    plain = BoxPack().make(instance, {"robot": "panda", "walls": "0"})
    shown = WindowEnv(BoxPack().make(instance, {"robot": "panda", "walls": "0"}), connect(), waits.append)
    try:
        state = plain.reset()
        motion = carried_out(plain, state)
        assert shown.apply(state, PICK, motion) == plain.apply(state, PICK, motion)
        assert len(waits) > 10
    finally:
        plain.close()
        shown.close()
        shown.close()


def test_without_a_screen_there_is_one_clear_line(instance, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    with pytest.raises(Exception, match="DISPLAY is not set, so there is no screen to open it on"):
        BoxPack().make_in_window(instance, {"robot": "panda", "walls": "0"})
