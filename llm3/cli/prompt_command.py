"""Print what a model would be sent first, without sending it."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from typing import TextIO

from llm3.assembly import choose_instance, given_skeleton, open_problem
from llm3.cli.problem_arguments import (
    add_problem_arguments,
    add_prompt_arguments,
    add_world_arguments,
    chosen_domain,
    chosen_options,
    loaded_instance,
)
from llm3.cli.text import emit
from llm3.jsonio import dumps
from llm3.prompts import Prompt
from llm3.registry import Registry
from llm3.solve import context_of


def add_arguments(parser: ArgumentParser) -> None:
    """Add the command's arguments."""
    add_problem_arguments(parser)
    add_world_arguments(parser)
    add_prompt_arguments(parser)
    parser.add_argument("--json", action="store_true", help="print the messages as JSON")


def run(arguments: Namespace, out: TextIO) -> int:
    """Run the command."""
    registry = Registry.discover()
    domain = chosen_domain(registry, arguments)
    strategy = registry.strategy(arguments.strategy)
    prompt = Prompt(strategy)
    instance = loaded_instance(domain, arguments)
    if instance is None:
        instance = choose_instance(domain, arguments.setting, arguments.seed)
    skeleton = given_skeleton(domain, instance, strategy, arguments.strategy)
    source = str(arguments.instance or "")
    with open_problem(domain, instance, chosen_options(arguments), source=source) as problem:
        env = problem.env
        messages = prompt.render(context_of(env, env.reset(), skeleton=skeleton))
    text = dumps(messages) if arguments.json else "\n\n".join(f"--- {m.role} ---\n\n{m.content}" for m in messages)
    emit(text + "\n", out)
    return 0
