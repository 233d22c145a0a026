"""The kit finds each fault that is planted in a domain, and says what it is and what may be the cause."""

from __future__ import annotations

import broken_answers
import broken_changes
import broken_depots
import broken_memories
import broken_sights
import broken_words
import pytest
from depot import Depots, a_depot
from yard import Yards

import llm3_birrt.plugin
import llm3_words.plugin
from llm3 import Registry, Strategy, hookimpl
from llm3.testing import check_domain

FAULTS = (
    broken_words.FAULTS
    | broken_answers.FAULTS
    | broken_memories.FAULTS
    | broken_changes.FAULTS
    | broken_depots.FAULTS
    | broken_sights.FAULTS
)


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
    sound = Yards(), broken_memories.SOUND, Depots(), broken_sights.sound()
    assert [check_domain(domain) for domain in sound] == [()] * len(sound)


def test_a_description_without_numbers_is_no_fault(registry):
    assert check_domain(broken_depots.told_by_halves(40), seeds=(0,), registry=registry) == ()


def test_a_stand_in_may_miss_the_goal_where_the_domain_knows_a_solution(registry):
    domain = a_depot(goal=broken_depots.never_there, witness=lambda self, setting, seed: ())
    found = check_domain(domain, seeds=(0,), registry=registry)
    assert [complaint.rule for complaint in found] == ["the witness solves the problem"]


@pytest.mark.parametrize("fault", ["one verdict too few", "a verdict for each joint", "one verdict for all"])
def test_what_follows_from_a_malformed_answer_is_not_told(registry, fault):
    (complaint,) = check_domain(FAULTS[fault].plugin, seeds=(0,), registry=registry)
    assert complaint.rule == "validity is one answer a configuration"


@pytest.mark.parametrize("fault", broken_memories.FAULTS)
def test_what_a_world_remembers_is_told_first(registry, fault):
    first, *_ = check_domain(FAULTS[fault].plugin, seeds=(0,), registry=registry)
    assert first.rule == FAULTS[fault].rule


@pytest.mark.parametrize("fault", FAULTS)
def test_each_fault_is_found_and_named(registry, fault):
    planted = FAULTS[fault]
    complaints = check_domain(planted.plugin, seeds=planted.seeds, registry=registry)
    assert planted.found_in(complaints), "\n".join(f"{c.rule}: {c}" for c in complaints)
