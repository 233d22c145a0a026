"""llm3 as a shell runs it, and plugins that are there without pip."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from project import tomllib

CORRIDOR = Path(__file__).parent / "third_party" / "llm3_corridor"
FOREIGN = (
    "LLM3_",
    "OPENAI_",
    "ANTHROPIC_",
    "GEMINI_",
    "OPENROUTER_",
    "PYTHONWARNINGS",
    "COLUMNS",
    "LINES",
    "TERM",
    "NO_COLOR",
    "FORCE_COLOR",
    "TTY_",
)
"""Variables, by how they begin, that would let this machine's habits into the tests."""


@dataclass(frozen=True)
class Ended:
    """How a command ended."""

    code: int
    out: str
    err: str


def environment(*folders: Path, **variables: str) -> Mapping[str, str]:
    """The surroundings of a command: what is in the folders can be imported, no proxy, no key."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(FOREIGN) and not k.lower().endswith("_proxy")}
    return {**kept, "PYTHONPATH": os.pathsep.join(map(str, folders)), **variables}


def llm3(line: str, python: str | Path = sys.executable) -> list[str]:
    """The command of `llm3 LINE` (no quotes), with every warning an error."""
    return [str(python), "-W", "error", "-m", "llm3", *line.split()]


def run(command: list[str], cwd: Path, env: Mapping[str, str]) -> Ended:
    """Run a command to its end."""
    done = subprocess.run(command, cwd=cwd, env=env, capture_output=True, text=True, encoding="utf-8", timeout=300)
    return Ended(done.returncode, done.stdout, done.stderr)


def install_plugin(folder: Path, name: str, source: str) -> None:
    """Put a one-module distribution into a folder: enough for an entry point to be found there."""
    (folder / f"{name}.py").write_text(source, encoding="utf-8")
    _install_metadata(folder, name, "1.0", name.removeprefix("llm3_"), name)


def install_package(folder: Path, package: Path) -> None:
    """Put what is in the folder of a package, with a pyproject.toml, into a folder, about as pip does."""
    project = tomllib.loads((package / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    ((entry_point, module),) = project["entry-points"]["llm3"].items()
    name = module.partition(".")[0]
    shutil.copytree(package / name, folder / name)
    _install_metadata(folder, project["name"], project["version"], entry_point, module)


def _install_metadata(folder: Path, name: str, version: str, entry_point: str, module: str) -> None:
    info = folder / f"{name.replace('-', '_')}-{version}.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n", encoding="utf-8")
    (info / "entry_points.txt").write_text(f"[llm3]\n{entry_point} = {module}\n", encoding="utf-8")


def install_corridor(folder: Path) -> None:
    """Put the corridor, a domain that is quick to make, into a folder."""
    install_plugin(folder, "llm3_corridor", (CORRIDOR / "llm3_corridor.py").read_text(encoding="utf-8"))
