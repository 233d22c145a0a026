"""What pyproject.toml says, and the packages that stand on the shelves."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib  # pytest and hatchling bring it to older Pythons

ROOT = Path(__file__).resolve().parents[1]
SHELVES = (".", "plugins", "domains", "templates")


def pyproject() -> Any:
    return tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))


def packages() -> dict[str, Path]:
    """The folder of each package, relative to the checkout, by its import name."""
    found = [path.parent.relative_to(ROOT) for shelf in SHELVES for path in (ROOT / shelf).glob("*/__init__.py")]
    return {folder.name: folder for folder in found}


def shipped(folder: Path) -> set[str]:
    """The product files of a package, as they are called inside a wheel."""
    kinds = (".py", ".j2", ".jinja", ".json", ".toml", ".urdf", ".js", ".css")
    found = [path for path in (ROOT / folder).rglob("*") if path.suffix in kinds or path.name == "py.typed"]
    return {path.relative_to((ROOT / folder).parent).as_posix() for path in found}
