"""The product is the wheel, not the checkout: what is in it, and that it works where nothing else is."""

from __future__ import annotations

import json
import shutil
from zipfile import ZipFile

import pytest
from command_line import CORRIDOR, environment, llm3, run
from project import ROOT, packages, shipped

pytestmark = pytest.mark.slow
WHERE = "import importlib, sys; print(*(importlib.import_module(name).__file__ for name in sys.argv[1:]), sep='\\n')"


def test_the_wheel_holds_every_product_file_and_nothing_else(wheel):
    expected = set().union(*(shipped(folder) for folder in packages().values()))
    held = {name for name in ZipFile(wheel).namelist() if ".dist-info/" not in name}
    assert held == expected
    assert {"llm3/py.typed", "llm3_templates/partials/trace.j2"} <= held


def test_the_wheel_names_its_licence_and_its_commands(wheel):
    archive = ZipFile(wheel)
    info = next(name for name in archive.namelist() if name.endswith(".dist-info/METADATA")).partition("/")[0]
    assert f"{info}/licenses/LICENSE" in archive.namelist()
    assert "llm3 = llm3.cli.main:main" in archive.read(f"{info}/entry_points.txt").decode()


def test_an_editable_installation_is_the_checkout(scratch, tmp_path):
    scratch.install("--editable", ROOT)
    ended = run([str(scratch.python), "-c", WHERE, *packages()], tmp_path, environment())
    assert ended.out.splitlines() == [str(ROOT / folder / "__init__.py") for folder in packages().values()], ended.err
    listed = run(llm3("list --json", python=scratch.python), tmp_path, environment())
    assert json.loads(listed.out)["broken"] == []


def test_a_third_party_domain_works_with_the_wheel(scratch, wheel, tmp_path):
    package = tmp_path / "llm3_corridor"
    shutil.copytree(CORRIDOR, package, ignore=shutil.ignore_patterns("__pycache__"))
    scratch.install(wheel, package)
    empty = tmp_path / "empty"
    empty.mkdir()

    found = run([str(scratch.python), "-c", WHERE, "llm3_corridor", *packages()], empty, environment())
    assert all(line.startswith(str(scratch.packages)) for line in found.out.splitlines()), found

    listed = run([str(scratch.python.with_name("llm3")), "list", "--json"], empty, environment())
    (corridor,) = [domain for domain in json.loads(listed.out)["domain"] if domain["name"] == "corridor"]
    assert corridor["plugin"] == "corridor (llm3-corridor 0.1.0)"

    ended = run(llm3("--domain corridor", python=scratch.python), empty, environment())
    assert ended.code == 0, ended.err
    assert ended.out.startswith("go([], {'x': ")
    assert ended.err.startswith("No language model is used: domain 'corridor' has no rule-based stand-in, ")

    pytest_ = [str(scratch.python), "-W", "error", "-m", "pytest", "-q", "-p", "no:cacheprovider", str(package)]
    tested = run(pytest_, package, environment())
    assert tested.code == 0, tested.out
