from __future__ import annotations

import os
import platform
import subprocess
import sys

import pytest

from llm3.errors import LLM3Error, MissingDependency
from llm3_bullet.clients import connect, quiet, require_pybullet


def add_box(client, height: float) -> int:
    shape = client.createCollisionShape(client.GEOM_BOX, halfExtents=[0.1, 0.1, 0.1])
    return client.createMultiBody(1.0, shape, basePosition=[0, 0, height])


def test_two_worlds_do_not_notice_each_other():
    with connect() as one, connect() as other:
        body = add_box(one, 1.0)
        add_box(other, 5.0)
        add_box(other, 6.0)
        one.setGravity(0, 0, -9.81)
        for _ in range(10):
            one.stepSimulation()
        assert one.id != other.id
        assert (one.getNumBodies(), other.getNumBodies()) == (1, 2)
        assert one.getBasePositionAndOrientation(body)[0][2] < 1.0
        assert other.getBasePositionAndOrientation(body)[0][2] == 5.0


def test_closing_one_world_leaves_the_other_alone():
    with connect() as one:
        other = connect()
        other.close()
        add_box(one, 1.0)
        assert one.getNumBodies() == 1


def test_closing_twice_does_no_harm_to_a_world_that_took_the_number():
    first = connect()
    first.close()
    with connect() as second:
        first.close()
        assert second.isConnected()


def test_a_context_closes_its_world():
    with connect() as client:
        assert client.is_open
    assert not client.is_open
    assert not require_pybullet().isConnected(physicsClientId=client.id)


def test_constants_and_the_class_of_errors_are_there_too():
    with connect() as client:
        assert client.GEOM_BOX == require_pybullet().GEOM_BOX
        with pytest.raises(client.error), quiet():
            client.loadURDF("nowhere.urdf")


def test_an_unknown_function_is_an_attribute_error():
    with connect() as client, pytest.raises(AttributeError):
        client.no_such_function  # noqa: B018  # reading it is the test


def test_importing_and_connecting_print_nothing():
    program = "from llm3_bullet.clients import connect; connect().close(); print('done')"
    paths = "import sys; sys.path[:0] = " + repr(sys.path) + "; "
    run = subprocess.run([sys.executable, "-c", paths + program], capture_output=True, text=True, check=True)
    assert (run.stdout, run.stderr) == ("done\n", "")


def test_quiet_silences_native_code_and_lets_go_again(capfd):
    with quiet():
        subprocess.run([sys.executable, "-c", "import os; os.write(1, b'out'); os.write(2, b'err')"], check=True)
    os.write(1, b"heard\n")
    assert capfd.readouterr() == ("heard\n", "")


def test_a_missing_pybullet_is_one_line(monkeypatch):
    monkeypatch.setitem(sys.modules, "pybullet", None)
    monkeypatch.setattr(platform, "python_implementation", lambda: "CPython")
    monkeypatch.setattr(platform, "python_version", lambda: "3.13.1")
    monkeypatch.setattr(platform, "system", lambda: "Darwin")
    monkeypatch.setattr(platform, "machine", lambda: "arm64")
    with pytest.raises(MissingDependency) as caught:
        connect()
    assert str(caught.value) == (
        "this needs PyBullet, which is not installed: its wheels exist for Linux x86-64 on CPython 3.9 to 3.11 only, "
        "and this is CPython 3.13.1 on Darwin arm64."
    )


def test_a_window_without_a_screen_is_one_line(monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    with pytest.raises(LLM3Error) as caught:
        connect(gui=True)
    assert str(caught.value) == (
        "PyBullet cannot open a window: DISPLAY is not set, so there is no screen to open it on."
    )


class CrowdedPyBullet:
    """Stands in for a PyBullet that refuses to connect."""

    GUI, DIRECT = 1, 2
    error = RuntimeError

    def __init__(self, raises: bool) -> None:
        self.raises = raises

    def connect(self, mode: int) -> int:
        if self.raises:
            raise self.error("no")
        return -1


@pytest.mark.parametrize("raises", [True, False])
@pytest.mark.parametrize(
    ("gui", "sentence"),
    [
        (True, "PyBullet cannot open a window, or one is open already: it shows one world a process."),
        (False, "PyBullet has no room for another world: close one of the open ones."),
    ],
)
def test_a_refused_connection_is_one_line(monkeypatch, raises, gui, sentence):
    monkeypatch.setitem(sys.modules, "pybullet", CrowdedPyBullet(raises))
    monkeypatch.setenv("DISPLAY", ":0")
    with pytest.raises(LLM3Error) as caught:
        connect(gui=gui)
    assert str(caught.value) == sentence
