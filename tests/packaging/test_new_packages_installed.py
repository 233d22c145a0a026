"""What `llm3 new` writes, as a stranger gets it: written, installed, tested, checked and run, with no edit."""

from __future__ import annotations

import shutil

import pytest
from command_line import environment, llm3, run

from llm3.scaffold import KINDS

pytestmark = pytest.mark.slow
PYBULLET = pytest.param("domain --bullet", marks=pytest.mark.pybullet, id="domain with PyBullet")


@pytest.mark.parametrize("kind", [*KINDS, PYBULLET])
def test_it_works_with_no_edit(scratch, wheel, tmp_path, kind):
    work = tmp_path / "work"
    work.mkdir()
    scratch.install(wheel)
    surroundings = environment()

    def typed(line: str) -> str:
        command, _, arguments = line.partition(" ")
        words = {
            "llm3": llm3(arguments, python=scratch.python),
            "pytest": [str(scratch.python), "-W", "error", "-m", "pytest", "-q", *arguments.split()],
        }[command]
        ended = run(words, work, surroundings)
        assert ended.code == 0, f"{line}: {ended.out}{ended.err}"
        return ended.out

    said = typed(f"llm3 new {kind} my-own").splitlines()
    install, *others = [line.strip() for line in said[1:]]
    assert install == "pip install -e my-own"
    scratch.install("--editable", work / "my-own")
    for line in others:  # the next commands, as they were printed
        typed(line)
    assert "my-own (llm3-my-own 0.1.0)" in typed("llm3 list")

    scratch.install("--force-reinstall", work / "my-own")  # what pip builds holds all that is needed
    shutil.rmtree(work / "my-own" / "llm3_my_own")
    typed(others[0])
