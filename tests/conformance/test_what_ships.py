"""Everything that ships keeps the rules, by being registered; so do the domains of the manual and of the tutorial."""

from __future__ import annotations

import importlib
import json
import re
from importlib import metadata
from types import ModuleType

import pytest
from project import ROOT

from llm3 import BackendSettings, Registry
from llm3.cli.check_command import KINDS
from llm3.cli.main import main
from llm3.testing import LLMServer, check_backend, check_domain

REGISTRY = Registry.discover([e for e in metadata.entry_points(group="llm3") if e.dist and e.dist.name == "llm3"])
NEEDS = {"http": "a server", "litellm": "a model", "replay": "a recording", "scripted": "a file"}
"""Backends that cannot be made from their name alone."""
QUICK = [(k, name) for k in KINDS[1:] for name in REGISTRY.names(k) if not (k == "backend" and name in NEEDS)]
PYBULLET = ("blocks", "boxpack", "kitchen")
"""Domains whose worlds take seconds to make."""


def marks(name: str, setting: str) -> list[pytest.MarkDecorator]:
    """What is quick is looked at each time: the usual setting of what needs no simulator."""
    bullet = [pytest.mark.pybullet] if name in PYBULLET else []
    return [*bullet, *([pytest.mark.slow] if bullet or setting != REGISTRY.domain(name).default_setting else [])]


LARGE = re.compile(r"dense-(8|10|12)|(far|clutter|lanes)-8|rebuild-(8|10)|blocks-(8|10)|kitchen-(8|10)|cramped-(6|8)")
"""Settings that differ from others by their size alone, and take long to look at."""
SETTINGS = [
    pytest.param(name, setting, marks=marks(name, setting))
    for name in REGISTRY.names("domain")
    for setting in REGISTRY.domain(name).settings
    if not LARGE.fullmatch(setting)
]
NOTHING_TO_DO = '{"Reasoning": "", "Full Plan": []}'


def told(capsys: pytest.CaptureFixture[str], line: str) -> tuple[int, list[str]]:
    code = main(["check", *line.split()])
    return code, capsys.readouterr().out.splitlines()


@pytest.mark.parametrize(("kind", "name"), QUICK)
def test_every_plugin_that_ships_is_clean(capsys, kind, name):
    code, lines = told(capsys, f"{name} --kind {kind}")
    assert code == 0, lines
    assert lines[-1].startswith(f"{kind} {name!r}: no fault (")


@pytest.mark.parametrize(("name", "setting"), SETTINGS)
def test_every_domain_that_ships_is_clean(capsys, name, setting):
    code, lines = told(capsys, f"{name} --setting {setting}")
    assert code == 0, lines


def test_the_backends_that_need_something_are_clean_once_they_have_it(tmp_path, monkeypatch):
    with LLMServer(lambda request: NOTHING_TO_DO) as server:
        monkeypatch.setenv("LLM3_BASE_URL", server.url)
        assert check_backend(REGISTRY.backend("http", BackendSettings(model="toy"))) == ()
        assert server.requests
    script = tmp_path / "replies.json"
    script.write_text(json.dumps([NOTHING_TO_DO, "other words"]), encoding="utf-8")
    assert check_backend(REGISTRY.backend("scripted", BackendSettings(argument=str(script)))) == ()


@pytest.fixture
def module(tmp_path, monkeypatch):
    """Imports this source as a module of this name."""

    def imported(name: str, source: str) -> ModuleType:
        (tmp_path / f"{name}.py").write_text(source, encoding="utf-8")
        monkeypatch.syspath_prepend(tmp_path)
        return importlib.import_module(name)

    return imported


def test_the_domain_of_the_front_page_is_clean(module):
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (code, *_) = re.findall(r"^```python\n(.*?)^```", readme, flags=re.MULTILINE | re.DOTALL)
    assert check_domain(module("front_page_room", code).Rooms()) == ()


def test_the_domain_of_the_tutorial_is_clean(module):
    source = (ROOT / "tests/third_party/llm3_corridor/llm3_corridor.py").read_text(encoding="utf-8")
    assert check_domain(module("tutorial_corridor", source).Corridor()) == ()
