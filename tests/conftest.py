"""Which tests run: slow ones when asked for, PyBullet ones where there is a PyBullet, and on which copy of llm3."""

from __future__ import annotations

import importlib.util
import os
from pathlib import Path

import pytest
from hypothesis import settings
from packaging.requirements import Requirement
from project import ROOT, packages, pyproject

PYBULLET_FOLDERS = ("blocks", "bullet", "boxpack", "kitchen")
"""Test folders whose names begin so need PyBullet; a single test elsewhere is marked `pybullet`."""

collect_ignore = ["third_party"]  # other people's packages: tests/packaging installs them and runs their tests

# A deadline is an absolute time, and fails on a busy machine.
settings.register_profile("llm3", deadline=None, derandomize=bool(os.environ.get("CI")))
settings.load_profile("llm3")


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("llm3")
    group.addoption("--slow", action="store_true", default=bool(os.environ.get("LLM3_SLOW")), help="run slow tests too")
    group.addoption("--installed", action="store_true", help="fail if llm3 is imported from the checkout")


def pytest_configure(config: pytest.Config) -> None:
    inside = [place for place in _places() if place.is_relative_to(ROOT)]
    if config.getoption("--installed") and inside:
        raise pytest.UsageError(f"--installed: {inside[0]} is in the checkout {ROOT}, not in an environment.")


def pytest_report_header(config: pytest.Config) -> list[str]:
    slow = "run" if config.getoption("--slow") else "are deselected (--slow runs them)"
    bullet = "run" if _pybullet_expected() else "are left out: PyBullet has no wheel for this Python or machine"
    return [f"llm3: {_places()[0]}", f"slow tests {slow}; PyBullet tests {bullet}"]


def pytest_ignore_collect(collection_path: Path) -> bool | None:
    of_pybullet = collection_path.parent == ROOT / "tests" and collection_path.name.startswith(PYBULLET_FOLDERS)
    return True if of_pybullet and not _pybullet_expected() else None


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    left_out = set()
    if not config.getoption("--slow"):
        left_out.add("slow")
    if not _pybullet_expected():
        left_out.add("pybullet")
    deselected = [item for item in items if any(item.get_closest_marker(name) for name in left_out)]
    config.hook.pytest_deselected(items=deselected)
    items[:] = [item for item in items if item not in deselected]


def _pybullet_expected() -> bool:
    """Whether llm3 depends on PyBullet here. Where it does and PyBullet is missing, tests fail."""
    wanted = map(Requirement, pyproject()["project"]["dependencies"])
    return any(r.name == "pybullet" and (r.marker is None or r.marker.evaluate()) for r in wanted)


def _places() -> list[Path]:
    """The files from which llm3 and its built-in plugins are imported."""
    specs = (importlib.util.find_spec(name) for name in sorted(packages()))
    return [Path(spec.origin).resolve() for spec in specs if spec and spec.origin]
