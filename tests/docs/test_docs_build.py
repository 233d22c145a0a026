from __future__ import annotations

import importlib
import subprocess
import sys
import zlib
from pathlib import Path

import pytest
from docs_pages import DOCS

pytestmark = pytest.mark.slow

PUBLIC = ("llm3", "llm3.types", "llm3.interfaces", "llm3.records", "llm3.testing")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The manual, built with every warning an error and no reference left open."""
    out = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-n", "-d", f"{out}/doctrees", DOCS, out]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    return out


def documented(site: Path) -> set[str]:
    """The names of all objects that the manual describes, and those by which they are known besides."""
    inventory = (site / "objects.inv").read_bytes().split(b"\n", 4)[4]
    return {line.split()[0] for line in zlib.decompress(inventory).decode().splitlines()}


def test_the_manual_builds_without_a_warning(site):
    for page in DOCS.glob("*.md"):
        assert (site / f"{page.stem}.html").exists()


@pytest.mark.parametrize("module", PUBLIC)
def test_every_public_name_is_in_the_reference(site, module):
    names = documented(site)
    public = importlib.import_module(module)
    for name in public.__all__:
        thing = getattr(public, name)
        elsewhere = f"{getattr(thing, '__module__', '')}.{name}"
        assert f"{module}.{name}" in names or elsewhere in names, name


def test_signatures_are_written_for_people(site):
    html = (site / "api.html").read_text(encoding="utf-8")
    for rubbish in ("TypeAliasForwardRef", "&lt;function", "&lt;factory", "seconds={}"):
        assert rubbish not in html
