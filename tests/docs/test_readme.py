"""The README's code works as it stands, and its commands are those that CI runs."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", README, flags=re.MULTILINE | re.DOTALL)


def test_the_domain_and_its_test_with_a_fake_model_work(tmp_path):
    domain, test = blocks("python")
    (tmp_path / "room.py").write_text(domain, encoding="utf-8")
    (tmp_path / "test_room.py").write_text(f"from room import Room, Wall\n{test}", encoding="utf-8")
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tmp_path)]
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "1 passed" in ran.stdout


def test_the_domain_has_thirty_lines_and_the_test_ten():
    def lines(text: str) -> int:
        code = [line for line in text.splitlines() if line.strip()]
        return len([line for line in code if not line.startswith(("from ", "import "))])

    domain, test = blocks("python")
    assert lines(domain) <= 30
    assert lines(test) <= 10


def test_ci_runs_the_test_command_of_the_readme():
    pattern = "^pip install .* && pytest$"
    assert pattern in (ROOT / ".ci" / "run").read_text(encoding="utf-8")
    assert re.findall(pattern, README, flags=re.MULTILINE) == ["pip install '.[test]' && pytest"]


@pytest.mark.parametrize("link", sorted(set(re.findall(r"\]\((?!https?:)([^)#]+)", README))))
def test_links_lead_somewhere(link):
    assert (ROOT / link).exists()
