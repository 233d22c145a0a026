"""The page on testing: its code is a test file that passes, and its tables name all that there is."""

import subprocess
import sys

from command_line import environment, install_corridor
from docs_pages import blocks, page, tables

import llm3_pytest
from llm3.testing import REPLY_FAULTS, WIRE_FAULTS


def test_the_code_on_the_page_is_a_test_file_that_passes(tmp_path):
    plugins, tests = tmp_path / "plugins", tmp_path / "tests"
    plugins.mkdir()
    tests.mkdir()
    install_corridor(plugins)
    code = "\n".join(block.text for block in blocks(page("testing"), "python"))
    (tests / "test_page.py").write_text(code, encoding="utf-8")
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tests)]
    surroundings = environment(plugins, NO_PROXY="127.0.0.1")
    ran = subprocess.run(command, cwd=tests, env=surroundings, capture_output=True, text=True, timeout=120, check=False)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert f"{code.count('def test_')} passed" in ran.stdout


def named(column):
    (found,) = [table for table in tables(page("testing")) if table.columns[0] == column]
    return found.names


def test_the_tables_name_every_fault_and_every_fixture():
    assert named("fault of a reply") == tuple(REPLY_FAULTS)
    assert named("fault of the wire") == tuple(WIRE_FAULTS)
    fixtures = {name for name, thing in vars(llm3_pytest).items() if "Fixture" in type(thing).__name__}
    assert set(named("fixture")) == fixtures
