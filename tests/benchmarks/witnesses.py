"""Carries out the witnesses of all settings that have one, and looks at each plan a second time.

python tests/benchmarks/witnesses.py [--seeds 20] [--first 0] [--domain NAME] [--setting NAME]
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from dataclasses import dataclass

from llm3.assembly import RunConfig, choose_instance, open_problem
from llm3.errors import LLM3Error, UnknownName
from llm3.interfaces import Domain, MotionPlanner, PlannerSettings
from llm3.prompts import Prompt
from llm3.registry import Registry
from llm3.solve import context_of
from llm3.witness import witness

DOMAINS = ("boxpack", "blocks", "kitchen")
TOKEN = 4
"""Characters of a token, roughly."""


@dataclass(frozen=True)
class Looked:
    """What was seen of one problem."""

    actions: int
    fault: str
    """Why the witness is no sound plan; empty if it is one."""
    characters: int
    """Of the state, as the prompt has it."""
    seconds: float
    """That it took to make the problem."""


def looked_at(domain: Domain, setting: str, seed: int, planner: MotionPlanner, prompt: Prompt) -> Looked:
    """One problem."""
    began = time.perf_counter()
    instance = choose_instance(domain, setting, seed)
    seconds = time.perf_counter() - began
    try:
        with open_problem(domain, instance, {}) as problem:
            text = prompt.render(context_of(problem.env, problem.env.reset()))[-1].content
            state = text[text.index("# Initial state") : text.index("# Earlier attempts")]
            plan = witness(problem, setting, seed, planner)
            return Looked(len(plan.actions), "", len(state), seconds)
    except LLM3Error as error:
        return Looked(0, f"{setting}, seed {seed}: {error}", 0, seconds)


def rows(arguments: argparse.Namespace) -> Iterator[str]:
    """The table, line by line."""
    registry = Registry.discover()
    usual = RunConfig("")
    planner = registry.planner(usual.planner, PlannerSettings(usual.planner_iterations, usual.planner_seconds))
    prompt = Prompt(registry.strategy(usual.strategy))
    seeds = range(arguments.first, arguments.first + arguments.seeds)
    slowest, faults = 0.0, []
    yield "| setting | sound witnesses | actions | tokens of the state, at most |"
    yield "|---|---|---|---|"
    domains = [registry.domain(name) for name in arguments.domain or DOMAINS]
    known = {setting: domain for domain in domains for setting in domain.settings if domain.witness(setting, 0)}
    for wanted in arguments.setting or ():
        if wanted not in known:
            raise UnknownName("setting", wanted, known)
    for setting, domain in known.items():
        if setting in (arguments.setting or known):
            found = [looked_at(domain, setting, seed, planner, prompt) for seed in seeds]
            faults += [one.fault for one in found if one.fault]
            slowest = max(slowest, *(one.seconds for one in found))
            lengths = {one.actions for one in found if not one.fault}
            actions = " to ".join(str(end) for end in sorted({min(lengths), max(lengths)})) if lengths else "-"
            sound = sum(not one.fault for one in found)
            tokens = max(one.characters for one in found) / TOKEN
            yield f"| `{setting}` | {sound} of {len(found)} | {actions} | {tokens:.0f} |"
    yield ""
    yield f"The slowest problem took {slowest:.2f} s to make."
    yield from faults


def main() -> None:
    """Read the arguments and print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--domain", action="append", choices=DOMAINS)
    parser.add_argument("--setting", action="append")
    try:
        for line in rows(parser.parse_args()):
            print(line, flush=True)  # noqa: T201  # a script
    except UnknownName as error:
        parser.error(str(error))


if __name__ == "__main__":
    main()
