from __future__ import annotations

import re

from docs_pages import page, table

from llm3.experiments import experiment_of, parse_toml
from llm3.registry import Registry

PAGE = page("benchmarks")


def test_every_problem_of_the_frontier_is_measured_on_all_of_its_seeds():
    asked = experiment_of(parse_toml(Registry.discover().experiment("frontier"), "frontier"), "frontier")
    shown = table(PAGE, "Settings that are made from solutions")
    assert shown.names == tuple(problem.setting for problem in asked.problems)
    solved = [cell for row in shown.rows for cell in (row[1], *row[4:])]
    assert {re.fullmatch(r"(\d+)/(\d+)", cell)[2] for cell in solved} == {str(len(asked.seeds))}
    assert f"All {len(list(asked.jobs())):,} runs" in PAGE
