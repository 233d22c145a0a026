"""The fixtures in a test suite of somebody else's."""

from __future__ import annotations

import json
import subprocess
import sys

import pytest
from command_line import environment

from llm3 import Registry
from llm3.testing import ScriptedLLM

SUITE = """
import json
import urllib.request


def test_a_script(scripted_llm):
    model = scripted_llm(["one"])
    assert model.complete(request()).text == "one"
    assert model.prompts == ["Plan!"]


def test_a_server(llm_server):
    for server in (llm_server(["one"]), llm_server(lambda request: "one")):
        asked = {"model": "toy", "messages": [{"role": "user", "content": "Plan!"}]}
        with urllib.request.urlopen(server.url + "/chat/completions", json.dumps(asked).encode()) as answer:
            assert json.load(answer)["choices"][0]["message"]["content"] == "one"


def test_a_registry(llm3_registry):
    assert "birrt" in llm3_registry.names("planner")
    llm3_registry.register(Mine(), "mine")


def test_a_registry_is_not_shared(llm3_registry):
    assert "mine" not in llm3_registry.names("planner")


class Mine:
    from llm3 import hookimpl

    @hookimpl
    def llm3_planners(self):
        return {"mine": object}


def request():
    from llm3.types import Context, Message, Request

    return Request((Message("user", "Plan!"),), Context("Go.", (), (), ()))
"""
OWN = """
import pytest

@pytest.fixture
def scripted_llm(): return 1

@pytest.fixture
def llm3_registry(): return 2

@pytest.fixture
def llm_server(): return 3

def test_mine(scripted_llm, llm3_registry, llm_server):
    assert (scripted_llm, llm3_registry, llm_server) == (1, 2, 3)
"""
LOADED = """
import sys

def pytest_sessionfinish(session):
    print("LOADED", sorted({name.partition(".")[0] for name in sys.modules}))
"""


def test_they_work_here_as_well(scripted_llm, llm3_registry, llm_server):
    assert scripted_llm is ScriptedLLM
    assert llm3_registry.names("planner") == Registry.discover().names("planner")
    assert llm_server(["one"]).url != llm_server(["one"]).url


def run_pytest(folder, *arguments):
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", *arguments, str(folder)]
    return subprocess.run(
        command, cwd=folder, env=environment(), capture_output=True, text=True, timeout=120, check=False
    )


def test_the_fixtures_are_there_wherever_llm3_is_installed(tmp_path):
    (tmp_path / "test_mine.py").write_text(SUITE, encoding="utf-8")
    ran = run_pytest(tmp_path)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "4 passed" in ran.stdout


def test_a_suite_that_does_not_use_them_does_not_load_llm3(tmp_path):
    (tmp_path / "test_nothing.py").write_text("def test_nothing(): pass\n", encoding="utf-8")
    (tmp_path / "conftest.py").write_text(LOADED, encoding="utf-8")
    ran = run_pytest(tmp_path)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    (line,) = [line for line in ran.stdout.splitlines() if "LOADED" in line]
    loaded = set(json.loads(line.partition("LOADED ")[2].replace("'", '"')))
    assert "llm3_pytest" in loaded
    assert not loaded & {"llm3", "numpy", "requests", "scipy", "pybullet"}


@pytest.mark.slow
def test_fixtures_of_ones_own_go_before(tmp_path):
    (tmp_path / "test_mine.py").write_text(OWN, encoding="utf-8")
    ran = run_pytest(tmp_path)
    assert ran.returncode == 0, ran.stdout + ran.stderr


@pytest.mark.slow
def test_they_can_be_turned_off(tmp_path):
    (tmp_path / "test_mine.py").write_text(SUITE, encoding="utf-8")
    ran = run_pytest(tmp_path, "-p", "no:llm3")
    assert all(f"fixture '{name}' not found" in ran.stdout for name in ("scripted_llm", "llm3_registry", "llm_server"))
