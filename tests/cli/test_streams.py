"""Streams that are closed, full of foreign names, or printed to by plugins."""

import json
import subprocess
import sys

from command_line import environment, install_corridor


def shell(line, cwd, *folders):
    command = f"{sys.executable} -m llm3 --domain corridor {line}"
    return subprocess.run(
        ["/bin/sh", "-c", command], cwd=cwd, env=environment(*folders), capture_output=True, text=True, timeout=120
    )


def test_a_closed_stderr_changes_no_result(tmp_path):
    install_corridor(tmp_path)
    ended = shell("--llm random --json --out here 2>&-", tmp_path, tmp_path)
    assert ended.returncode == 0
    assert json.loads(ended.stdout)["solved"]


def test_a_closed_stdout_changes_no_exit_code(tmp_path):
    install_corridor(tmp_path)
    assert shell("--llm random --out here >&-", tmp_path, tmp_path).returncode == 0
    assert shell("--setting none >&-", tmp_path, tmp_path).returncode == 2
    assert shell("--setting none 2>&- >&-", tmp_path, tmp_path).returncode == 2


def test_a_name_that_the_terminal_cannot_spell_costs_no_result(tmp_path):
    install_corridor(tmp_path)
    spell = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    command = [sys.executable, "-m", "llm3", "--domain", "corridor", "--llm", "random", "--json", "--out", b"\xff\xfe"]
    ended = subprocess.run(
        command, cwd=tmp_path, env={**environment(tmp_path), **spell}, capture_output=True, text=True, timeout=120
    )
    assert ended.returncode == 0, ended.stderr
    assert json.loads(ended.stdout)["solved"]
