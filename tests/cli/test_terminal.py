"""What a person at a terminal sees: 80 columns, a dumb one, and a model that would like to drive the cursor."""

from __future__ import annotations

import fcntl
import json
import os
import pty
import re
import struct
import subprocess
import termios
from pathlib import Path

import pytest
from command_line import llm3

SEQUENCE = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")
RUDE = "\x1b[2J\x1b]0;owned\x07\x9b31m\u202e"
"""Clears the screen, sets the title, turns the ink red and the text around."""

RUDE_REPLIES = (
    RUDE,
    json.dumps([f"jump{RUDE}([], {{}})"]),
    f'["jump{RUDE}([], {{}})"]',
    f'["go([{RUDE}], {{}})"]',
)


def in_terminal(command: list[str], cwd: Path, env: dict[str, str]) -> tuple[int, str]:
    """Run with all three streams on a terminal of 80 columns; the exit code and all that was written."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
    process = subprocess.Popen(command, cwd=cwd, env=env, stdin=theirs, stdout=theirs, stderr=theirs)
    os.close(theirs)
    written = b""
    try:
        while chunk := os.read(ours, 65536):
            written += chunk
    except OSError:  # how Linux says that the other side is closed
        pass
    os.close(ours)
    return process.wait(timeout=60), written.decode().replace("\r\n", "\n")


def visible(written: str) -> list[str]:
    """The lines that stay on the screen."""
    lines = SEQUENCE.sub("", written).split("\n")
    return [line.rpartition("\r")[2].rstrip() for line in lines]


@pytest.mark.parametrize("terminal", ["xterm-256color", "dumb"])
def test_a_run_reads_well(cwd, surroundings, terminal):
    command = llm3("--domain corridor --out here")
    code, written = in_terminal(command, cwd, {**surroundings, "TERM": terminal})
    assert code == 0
    assert ("\x1b[" in written) == (terminal != "dumb")
    lines = visible(written)
    assert "attempt 1 of 20: a plan of 2 actions" in lines
    assert any(re.fullmatch(r" +1\. go\(\[\], \{'x': [0-9.]+, 'y': [0-9.]+\}\): feasible", line) for line in lines)
    record = lines.index("record: here")
    assert lines[record - 1].startswith("solved in ")
    plan = [line for line in lines[record + 1 :] if line]
    assert plan
    assert all(line.startswith("go([], {'x': ") for line in plan)


@pytest.mark.parametrize("terminal", ["xterm-256color", "dumb"])
def test_long_lines_are_folded_between_words(cwd, surroundings, script, terminal):
    words = [f"word-{number}" for number in range(60)]
    command = llm3(f"--domain corridor --max-llm-calls 1 {script(json.dumps([' '.join(words) + '([], {})']))}")
    _, written = in_terminal(command, cwd, {**surroundings, "TERM": terminal})
    lines = visible(written)
    assert max(map(len, lines)) <= 80
    first = next(number for number, line in enumerate(lines) if "1. " in line)
    below = [line for line in lines[first + 1 :] if line.startswith("        ")]
    assert below
    assert not any(re.search(r"wor$|word$|word-$", line) for line in lines)


@pytest.mark.parametrize("terminal", ["xterm-256color", "dumb"])
def test_a_reply_cannot_drive_the_terminal(cwd, surroundings, script, terminal):
    command = llm3(f"--domain corridor --max-llm-calls 4 {script(*RUDE_REPLIES)}")
    code, written = in_terminal(command, cwd, {**surroundings, "TERM": terminal})
    assert code == 1
    assert "owned" in written
    rest = SEQUENCE.sub("", written)
    assert "\x1b" not in rest
    assert not set(rest) & {"\x07", "\x9b", "\u202e"}
    assert "\x1b[2J" not in written


def test_a_reply_cannot_drive_what_reads_a_pipe(corridor, script):
    ended = corridor(f"{script(*RUDE_REPLIES)} --max-llm-calls 4 --json")
    assert ended.code == 1
    assert all(c.isprintable() or c == "\n" for c in ended.out + ended.err)
