"""`llm3 list`, and that one broken plugin stops nothing."""

from __future__ import annotations

import json

import pytest

KINDS = ("domain", "strategy", "feedback", "planner", "timer", "backend", "model source", "experiment")
DOMAINS = "blocks, boxpack, corridor, kitchen, tabletop2d"
BROKEN = {
    "llm3_broken": (
        "raise RuntimeError('no\\x1b[2J such\\ntorque')",
        "broken (llm3_broken 1.0)",
        r"RuntimeError: no\x1b[2J such torque",
    ),
    "llm3_misspelt": (
        "from llm3 import hookimpl\n@hookimpl\ndef llm3_domain(): return {}",
        "misspelt (llm3_misspelt 1.0)",
        "plugin misspelt (llm3_misspelt 1.0) implements an unknown hook",
    ),
    "llm3_second": (
        "from llm3 import hookimpl\n@hookimpl\ndef llm3_domains(): return {'corridor': object}",
        "second (llm3_second 1.0)",
        "domain 'corridor' is registered by corridor (llm3_corridor 1.0) and by second (llm3_second 1.0).",
    ),
}


def test_list_shows_every_plugin_of_every_kind_and_where_it_comes_from(command):
    ended = command("list")
    assert (ended.code, ended.err) == (0, "")
    lines = ended.out.splitlines()
    assert [line[:-1] for line in lines if not line.startswith(" ")] == list(KINDS)
    shown = [" ".join(line.split()) for line in lines]
    assert "corridor corridor (llm3_corridor 1.0) A point robot walks down a corridor. Settings: default." in shown
    assert any(line.startswith("birrt birrt (llm3 ") for line in shown)


def test_list_as_json_is_one_object(command):
    ended = command("list --json")
    (line,) = ended.out.splitlines()
    told = json.loads(line)
    assert set(told) == {*KINDS, "broken"}
    assert told["broken"] == []
    lines = command("list").out.splitlines()
    for kind in KINDS:
        assert told[kind]
        for thing in told[kind]:
            assert set(thing) == {"name", "plugin", "description"}
            assert any(line.split()[0] == thing["name"] and thing["plugin"] in line for line in lines)


@pytest.mark.parametrize("name", BROKEN)
def test_a_broken_plugin_is_listed_and_stops_nothing(command, corridor, install, name):
    source, plugin, reason = BROKEN[name]
    reason = reason.replace(r"\x1b", " ")
    install(name, source)

    listed = command("list")
    assert listed.code == 0
    assert listed.out.splitlines()[-2] == "failed to load:"
    assert listed.out.splitlines()[-1].startswith(f"  {plugin}: {reason}")
    (broken,) = json.loads(command("list --json").out)["broken"]
    assert broken["plugin"] == plugin

    ended = corridor()
    assert ended.code == 0
    assert ended.err.splitlines()[0].startswith("No language model is used: ")
    assert ended.err.splitlines()[1].startswith(f"warning: plugin {plugin} failed to load: {reason}")

    unknown = command("--domain garden")
    assert unknown.code == 2
    (line,) = unknown.err.splitlines()
    assert line.startswith(
        f"llm3: error: unknown domain 'garden'. Known: {DOMAINS}. Failed to load: {plugin} ({reason}"
    )
    assert "\x1b" not in listed.out + ended.err + unknown.err


def test_a_domain_that_cannot_be_made_is_listed_with_the_reason(command, install):
    install(
        "llm3_unmade",
        "from llm3 import hookimpl\n@hookimpl\ndef llm3_domains(): return {'unmade': lambda: 1 / 0}",
    )
    (line,) = [line for line in command("list").out.splitlines() if "unmade" in line]
    assert line.split("  ")[-1] == (
        "unmade (llm3_unmade 1.0): domain 'unmade' cannot be made: ZeroDivisionError: division by zero"
    )


def test_a_checkout_that_was_never_installed_says_how_to_install_it(command, monkeypatch):
    monkeypatch.setattr("importlib.metadata.entry_points", lambda group: [])
    ended = command("list")
    assert (ended.code, ended.out) == (3, "")
    assert ended.err == (
        "llm3: error: llm3 is not installed, so it has no plugins: run 'pip install .' in its checkout.\n"
    )
