from __future__ import annotations

import subprocess
import sys
import sysconfig
import venv
from dataclasses import dataclass
from pathlib import Path

import pytest
from project import ROOT


@dataclass(frozen=True)
class Scratch:
    """A virtual environment that sees the packages of the running one, but for llm3."""

    folder: Path

    @property
    def python(self) -> Path:
        return self.folder / "bin" / "python"

    @property
    def packages(self) -> Path:
        (found,) = self.folder.glob("lib/python*/site-packages")
        return found

    def install(self, *what: str | Path) -> None:
        """pip install, without the network."""
        pip = [sys.executable, "-m", "pip", "--python", str(self.python), "--quiet", "--disable-pip-version-check"]
        flags = ["install", "--no-deps", "--no-index", "--no-build-isolation"]
        subprocess.run([*pip, *flags, *map(str, what)], check=True)


@pytest.fixture
def scratch(tmp_path: Path) -> Scratch:
    made = Scratch(tmp_path / "venv")
    venv.create(made.folder, symlinks=True)
    others = tmp_path / "others"
    others.mkdir()
    for place in {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}:
        for path in Path(place).iterdir():
            if "llm3" not in path.name:
                (others / path.name).symlink_to(path)
    # By its name it is read before the line of an editable installation, which imports a package from there.
    (made.packages / "00-others.pth").write_text(f"{others}\n")
    return made


@pytest.fixture(scope="session")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("dist")
    build = [sys.executable, "-m", "hatchling", "build", "--target", "wheel", "--directory", str(folder)]
    subprocess.run(build, cwd=ROOT, check=True, capture_output=True)
    (made,) = folder.glob("llm3-*.whl")
    return made
