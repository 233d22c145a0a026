"""The kit finds each fault that is planted in a domain, and says what it is and what may be the cause."""

from __future__ import annotations

import broken_answers
import broken_words
import pytest
from yard import Yards

import llm3_birrt.plugin
import llm3_words.plugin
from llm3 import Registry, Strategy, hookimpl
from llm3.testing import check_domain

FAULTS = broken_words.FAULTS | broken_answers.FAULTS


class OneStrategy:
    """Rendering is dear, and one strategy enough."""

    @hookimpl
    def llm3_strategies(self):
        return {"backtrack": lambda: Strategy("llm3_templates", "backtrack.j2")}


@pytest.fixture(scope="module")
def registry() -> Registry:
    found = Registry()
    for plugin in (llm3_birrt.plugin, llm3_words.plugin, OneStrategy()):
        found.register(plugin, f"{plugin} (test)")
    return found


def test_a_domain_without_a_fault_has_no_complaint():
    assert check_domain(Yards()) == ()


@pytest.mark.parametrize("fault", FAULTS)
def test_each_fault_is_found_and_named(registry, fault):
    planted = FAULTS[fault]
    complaints = check_domain(planted.plugin, seeds=planted.seeds, registry=registry)
    assert planted.found_in(complaints), "\n".join(f"{c.rule}: {c}" for c in complaints)
