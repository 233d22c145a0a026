"""The second opinion shares data with the rest, and no code: a mistake there must not hide itself here."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

import llm3_blocks.verification
import llm3_boxpack.verification
import llm3_bullet.verification

DATA = {"clients", "mounting", "poses", "robot", "scene", "verification"}
"""The modules of llm3_bullet that it may import: descriptions, connections, and how poses are written."""
OF_DOMAINS = {
    llm3_blocks: {("llm3_blocks", "actions"), ("llm3_blocks", "instance"), ("llm3_bullet", "tabletop")},
    llm3_boxpack: {("llm3_boxpack", name) for name in ("actions", "instance", "layout")},
}
"""What a domain's verifier may import besides: its data. Of what tabletops share, import-linter says more."""


def imported(file: Path) -> set[tuple[str, str]]:
    """What a file imports of our packages: (package, module)."""
    nodes = ast.walk(ast.parse(file.read_text(encoding="utf-8")))
    names = {node.module or "" for node in nodes if isinstance(node, ast.ImportFrom)}
    parts = (name.split(".") for name in names if name.startswith("llm3"))
    return {(part[0], part[1] if len(part) > 1 else "") for part in parts}


@pytest.mark.parametrize(
    "file", sorted(Path(llm3_bullet.verification.__file__).parent.glob("*.py")), ids=lambda f: f.stem
)
def test_the_library_imports_data_only(file):
    allowed = {("llm3_bullet", name) for name in DATA} | {("llm3", "types")}
    assert imported(file) <= allowed


@pytest.mark.parametrize(("domain", "own"), OF_DOMAINS.items(), ids=lambda d: getattr(d, "__name__", ""))
def test_a_domain_imports_data_only(domain, own):
    allowed = {("llm3_bullet", name) for name in DATA} | own
    assert imported(Path(domain.verification.__file__)) <= allowed | {("llm3", "types"), ("llm3", "interfaces")}
