"""`llm3 new`: what it says, what it refuses, and that nothing is lost by it."""

from __future__ import annotations

import ast
import re
from pathlib import Path, PurePosixPath

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from llm3.assembly import UNTIMED, RunConfig
from llm3.errors import LLM3Error, OutputExists, UsageError
from llm3.records.repetition import REPLAY
from llm3.scaffold import BULLET_DOMAIN, KINDS, Name, render, write

EVERY = {**KINDS, "domain with PyBullet": BULLET_DOMAIN}
WORDS = st.from_regex(r"[a-z][a-z0-9]{0,5}([-_][a-z0-9]{1,5}){0,2}", fullmatch=True)


def names(text: str) -> Name | None:
    try:
        return Name(text)
    except UsageError:
        return None


# ---- what is written ------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", EVERY)
@settings(max_examples=20)
@given(name=WORDS.map(names).filter(bool))
def test_what_is_written_is_python_with_docstrings_in_lines_of_120_letters(kind, name):
    assume(name.plugin not in ("none", "loop", "search", *EVERY[kind].used))
    files = render(EVERY[kind], name)
    assert {"README.md", "pyproject.toml", f"{name.module}/plugin.py", f"tests/test_{name.identifier}.py"} <= set(
        map(str, files)
    )
    for place, text in files.items():
        assert "{{" not in text
        assert max(map(len, text.splitlines()), default=0) <= 120
        assert text == "" or text.endswith("\n")
        if place.suffix == ".py":
            tree = ast.parse(text)
            if place.parts[0] != "tests":
                public = (ast.ClassDef, ast.FunctionDef)
                assert all(ast.get_docstring(node) for node in [tree, *tree.body] if isinstance(node, public))


@pytest.mark.parametrize(
    ("name", "module", "distribution", "title"),
    [
        ("rooms", "llm3_rooms", "llm3-rooms", "Rooms"),
        ("my-rooms", "llm3_my_rooms", "llm3-my-rooms", "MyRooms"),
        ("my_rooms2", "llm3_my_rooms2", "llm3-my-rooms2", "MyRooms2"),
    ],
)
def test_all_names_follow_from_one(name, module, distribution, title):
    known = Name(name)
    assert (known.module, known.distribution, known.title) == (module, distribution, title)


@pytest.mark.parametrize("kind", ["domain", "planner", "feedback", "backend", "strategy"])
def test_it_says_what_there_is_and_what_to_type_next(command, cwd, kind):
    ended = command("new", kind, "my-own", "--out", "of mine/x")
    assert (ended.code, ended.err) == (0, "")
    first, *following = ended.out.splitlines()
    files = [path for path in (cwd / "of mine" / "x").rglob("*") if path.is_file()]
    assert first == f"'of mine/x' holds {KINDS[kind].what} that works, in {len(files)} files. Next:"
    trial, checked = (text.replace("NAME", "my-own") for text in (KINDS[kind].trial, KINDS[kind].checked))
    assert following == [
        "  pip install -e 'of mine/x'",
        f"  llm3 {trial}",
        f"  llm3 check {checked}",
        "  pytest 'of mine/x'",
    ]
    readme = (cwd / "of mine" / "x" / "README.md").read_text(encoding="utf-8")
    assert f"\nllm3 {trial}\nllm3 check {checked}\n" in readme
    assert f" …` {KINDS[kind].tried}.\n" in readme


@pytest.mark.parametrize("kind", EVERY)
def test_the_readme_says_what_each_file_is_for_the_tests_as_well(kind):
    name = Name("my-own")
    files = render(EVERY[kind], name)
    told = re.findall(r"^\| `(.+?)` \| .+ \|$", files[PurePosixPath("README.md")], re.MULTILINE)
    there = {place.as_posix().removeprefix(f"{name.module}/") for place in files}
    assert sorted(told) == sorted(there - {"README.md", "pyproject.toml", "__init__.py", "py.typed"})


# ---- what is refused ------------------------------------------------------------------------------

A_NAME = (
    "a plugin's name is at most 24 lower-case letters and digits, a letter first, with single - or _ between them, "
    "such as my-rooms: not {!r}."
)
SENTENCES = {
    ("rooms", "x"): ("unknown kind of plugin 'rooms'. Known: backend, domain, feedback, planner, strategy."),
    ("domian", "x"): (
        "unknown kind of plugin 'domian'; did you mean 'domain'? Known: backend, domain, feedback, planner, strategy."
    ),
    ("domain",): "the following arguments are required: NAME. See 'llm3 new --help'.",
    ("planner", "x", "--bullet"): "--bullet is for a domain: leave it out for a planner.",
    ("planner", "class"): "'class' is a word of Python itself: choose another name, such as my-rooms.",
    ("domain", "test-rooms"): (
        "pytest takes classes that begin with Test for tests: choose another name, not 'test-rooms'."
    ),
    ("domain", "none"): "llm3 uses 'none' itself where a domain is named: choose another name, such as my-domain.",
    ("domain", "corridor"): "domain 'corridor' is registered by corridor (llm3_corridor 1.0): choose another name.",
    **{
        ("domain", name): A_NAME.format(name)
        for name in ("", "Rooms", "2rooms", "my--rooms", "rooms-", "my rooms", "../rooms", "räume", "a:b", "x" * 25)
    },
}


@pytest.mark.parametrize("words", SENTENCES, ids=" ".join)
def test_one_line_says_what_is_wrong(command, cwd, words):
    ended = command("new", *words)
    assert (ended.code, ended.out, ended.err) == (2, "", f"llm3: error: {SENTENCES[words]}\n")
    assert not list(cwd.iterdir())


def test_a_package_that_is_installed_is_not_hidden_by_a_new_one(command, cwd, install, plugins):
    install("llm3_elsewhere", "from llm3 import hookimpl\n@hookimpl\ndef llm3_domains(): return {}")
    ended = command("new planner elsewhere")
    place = plugins / "llm3_elsewhere.py"
    said = f"llm3: error: a package 'llm3_elsewhere' is installed, at {place}: choose another name.\n"
    assert (ended.code, ended.err) == (2, said)
    assert not list(cwd.iterdir())


def test_a_name_is_taken_within_its_kind_only(command, cwd):
    assert command("new feedback offline").code == 0
    assert command("new backend offline --out other").code == 2


@pytest.mark.parametrize("kind", EVERY)
def test_names_that_llm3_uses_itself_are_refused_whatever_is_installed(kind):
    usual, searched = RunConfig("none"), RunConfig("none", solver="search")
    asked = {
        "domain": set(),
        "planner": {usual.planner},
        "feedback": {usual.feedback},
        "backend": {usual.backend, RunConfig("none", model="any").backend, "random", REPLAY},
        "strategy": {usual.strategy},
    }
    registered = EVERY[kind].registered
    for name in asked[registered] | {UNTIMED, usual.solver, searched.solver}:
        with pytest.raises(UsageError) as caught:
            render(EVERY[kind], Name(name))
        assert str(caught.value) == (
            f"llm3 uses {name!r} itself where a {registered} is named: choose another name, such as my-{registered}."
        )


def test_nothing_is_overwritten(command, cwd):
    folder = cwd / "rooms"
    folder.mkdir()
    (folder / "mine.txt").write_text("mine")
    ended = command("new domain rooms")
    said = "llm3: error: 'rooms' is there already, and nothing is overwritten: choose another with --out.\n"
    assert (ended.code, ended.out, ended.err) == (2, "", said)
    assert [path.name for path in folder.iterdir()] == ["mine.txt"]
    (cwd / "file").write_text("mine")
    assert command("new domain rooms --out file").err == said.replace("'rooms'", "'file'")
    assert (cwd / "file").read_text() == "mine"


def test_an_empty_folder_is_as_good_as_none(command, cwd):
    (cwd / "here").mkdir()
    assert command("new domain rooms --out here").code == 0
    assert command("new domain rooms --out here").code == 2


def test_a_folder_that_cannot_be_made_is_told(tmp_path):
    (tmp_path / "file").write_text("")
    folder = tmp_path / "file" / "rooms"
    with pytest.raises(LLM3Error) as caught:
        write({Path("a.py"): ""}, folder)
    assert not isinstance(caught.value, OutputExists)
    assert str(caught.value) == f"'{folder}' cannot be written: Not a directory."
