"""What is asked for and is not there: exit code 2, one line that names it, what comes close and what there is."""

from __future__ import annotations

import signal
import sys
from concurrent.futures import ThreadPoolExecutor

import pytest

RUN_FLAGS = (
    "--debug, --domain, --feedback, --force, --gui, --help, --instance, --json, --llm, --max-llm-calls, "
    "--max-motion-calls, --max-reply-tokens, --max-seconds, --max-tokens-total, --model, "
    "--out, --planner, --planner-iterations, --planner-seconds, --prices, --quiet, "
    "--record, --seed, --setting, --solver, --strategy, --temperature, --timing, --trace-size, --version, -D, -h"
)
SED = f"unknown flag '--sed'; did you mean '--seed' or '--solver' or '--record'? Known: {RUN_FLAGS}."
DOMAINS = "blocks, boxpack, corridor, kitchen, tabletop2d"
SENTENCES = {
    "": f"no domain: give --domain NAME. Known: {DOMAINS}.",
    "--domain coridor": f"unknown domain 'coridor'; did you mean 'corridor'? Known: {DOMAINS}.",
    "--domain garden": f"unknown domain 'garden'. Known: {DOMAINS}.",
    "--domain corridor --setting defualt": (
        "unknown setting 'defualt' of domain 'corridor'; did you mean 'default'? Known: default."
    ),
    "--domain corridor --strategy backtrak": (
        "unknown strategy 'backtrak'; did you mean 'backtrack'? Known: backtrack, sample-params, scratch."
    ),
    "--domain corridor --feedback categorised": (
        "unknown feedback 'categorised'; did you mean 'categorized'? Known: binary, categorized, none."
    ),
    "--domain corridor --planner birt": "unknown planner 'birt'; did you mean 'birrt'? Known: birrt, ompl-bitstar, "
    "ompl-lbkpiece, ompl-rrtconnect.",
    "--domain corridor --llm ofline": (
        "unknown backend 'ofline'; did you mean 'offline'? Known: http, litellm, offline, random, replay, scripted."
    ),
    "--domain corridor -D walls=1": "unknown option 'walls' of domain 'corridor'. Known: none.",
    "--domain corridor -D walls": "argument -D: expected KEY=VALUE, not 'walls'. See 'llm3 --help'.",
    "--domain corridor --sed 3": SED,
    "--domain corridor --sed=3": SED,
    "--domain corridor --seed": "argument --seed: expected one argument. See 'llm3 --help'.",
    "--domain corridor --seed -1": (
        "argument --seed: expected a whole number from 0 to 9223372036854775807, not '-1'. See 'llm3 --help'."
    ),
    "--domain corridor --seed 9223372036854775808": (
        "argument --seed: expected a whole number from 0 to 9223372036854775807, not '9223372036854775808'. "
        "See 'llm3 --help'."
    ),
    "--domain corridor --max-llm-calls 0": "the number of model calls must be at least 1, not 0.",
    "--domain corridor --trace-size -1": "the trace size must be 0 or more, not -1.",
    "--domain corridor --planner-iterations -1": "the planner's iterations must be 0 or more, not -1.",
    "--domain corridor --out=": "argument --out: expected a path, not an empty text. See 'llm3 --help'.",
    "--domain corridor --temperature nan": "the temperature must be 0 or more, not nan.",
    "--domain corridor -D a=1 -D a=2": "-D a is given twice: a=1 and a=2.",
    "--domain corridor --llm offline:x": "the backend 'offline' takes no argument, so leave out ':x'.",
    "--domain corridor --planner-seconds nan": "the planner's seconds must be more than 0, not nan.",
    "--domain corridor --temperature hot": ("argument --temperature: invalid float value: 'hot'. See 'llm3 --help'."),
    "--domain corridor --llm offline --model gpt": (
        "the backend 'offline' uses no language model: leave out --model gpt, or --llm."
    ),
    "--domain corridor --gui": "domain 'corridor' has no window, which --gui needs.",
    "--domain corridor --llm scripted": (
        "the backend 'scripted' needs a JSON file with a list of replies: --llm scripted:replies.json."
    ),
    "--domain corridor --instance a.json --setting default": (
        "--setting and --instance both choose a problem: give one of them."
    ),
    "lst": (
        "unknown command 'lst'; did you mean 'list'? Known: check, doctor, execute, experiment, export, instance, "
        "list, models, new, prompt, render, report, results, run, verify."
    ),
    "--domain corridor list": (
        "unexpected argument 'list'. A command stands first: run, prompt, experiment, instance, verify, execute, "
        "export, report, render, results, models, doctor, check, new, list."
    ),
    "list --jsn": "unknown flag '--jsn'; did you mean '--json'? Known: --debug, --help, --json, -h.",
    "prompt --domain corridor --llm http": (
        "unknown flag '--llm'. Known: --debug, --domain, --help, --instance, --json, --seed, --setting, --strategy, "
        "-D, -h."
    ),
    "prompt": f"no domain: give --domain NAME. Known: {DOMAINS}.",
    "instance --domain corridor --setting wide": ("unknown setting 'wide' of domain 'corridor'. Known: default."),
}


@pytest.mark.parametrize(("line", "sentence"), SENTENCES.items(), ids=SENTENCES)
def test_one_line_says_what_is_wrong(command, cwd, line, sentence):
    ended = command(*line.split()) if line else command("run")
    assert (ended.code, ended.out, ended.err) == (2, "", f"llm3: error: {sentence}\n")
    assert not list(cwd.iterdir())


def test_debug_adds_the_traceback(command):
    ended = command("--domain garden --debug")
    assert ended.code == 2
    assert ended.err.startswith("Traceback (most recent call last):\n")
    assert ended.err.endswith(f"\nllm3: error: unknown domain 'garden'. Known: {DOMAINS}.\n")


def test_debug_is_heard_when_the_arguments_cannot_be_read(command):
    assert "Traceback" in command("--debug --sed 3").err


def test_control_characters_of_the_user_do_not_reach_the_terminal(command):
    ended = command("--domain", "\x1b[2J\x07")
    assert (ended.code, ended.err) == (2, rf"llm3: error: unknown domain '\x1b[2J\x07'. Known: {DOMAINS}." "\n")


def test_a_command_leaves_signals_and_streams_as_they_were(command):
    before = signal.getsignal(signal.SIGTERM), sys.stdout
    command("list")
    assert (signal.getsignal(signal.SIGTERM), sys.stdout) == before


def test_a_command_runs_in_any_thread(command):
    with ThreadPoolExecutor() as threads:
        assert threads.submit(command, "list").result().code == 0
