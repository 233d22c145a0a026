"""All rules for domains, in the order in which they are looked at."""

from __future__ import annotations

from llm3.testing.conformance import (
    capability_rules,
    catalogue_rules,
    description_rules,
    hand_rules,
    memory_rules,
    motion_rules,
    outcome_rules,
    purity_rules,
    schema_rules,
    series_rules,
    sight_rules,
    solution_rules,
    state_rules,
    text_rules,
    twin_rules,
)

INSTEAD = "every state has an answer, and what the robot cannot do is a Failure, and not an exception"
FORM_RULES = (*schema_rules.FORM_RULES, capability_rules.regions_are_parts_of_the_ranges)
"""Looked at before any action is drawn."""
LOSSES = (*outcome_rules.FORM_RULES, *hand_rules.LOSSES)
"""Looked at before anything is asked of states that actions led to."""
FOREIGN_RULES = twin_rules.FOREIGN_RULES
FIRST_RULES = (*state_rules.RULES, *schema_rules.RULES, *outcome_rules.RULES)
MEMORY_RULES = memory_rules.RULES
"""Looked at before other rules are misled by what a world remembers."""
WORLD_RULES = (
    *motion_rules.RULES,
    *hand_rules.RULES,
    *outcome_rules.LAST_RULES,
    *text_rules.RULES,
    *description_rules.RULES,
    *solution_rules.RULES,
    *capability_rules.RULES,
)
DEAR_RULES = (
    capability_rules.the_verifier_tells_good_plans_from_bad,
    *solution_rules.DEAR_RULES,
    *sight_rules.RULES,
)
"""Looked at in the first problem of each setting only."""
PURITY_RULES = purity_rules.RULES
TWIN_RULES = (*twin_rules.RULES, capability_rules.a_remade_world_is_like_a_new_one)
"""Looked at where a world keeps nothing to itself; another could not be compared with it."""
LAST_RULES = (twin_rules.closing_twice_does_no_harm,)
"""The world is closed after them."""
RULES = (
    catalogue_rules.a_domain_says_what_it_is,
    *catalogue_rules.RULES,
    *FORM_RULES,
    *FOREIGN_RULES,
    *LOSSES,
    *FIRST_RULES,
    *MEMORY_RULES,
    *WORLD_RULES,
    *DEAR_RULES,
    *PURITY_RULES,
    *TWIN_RULES,
    *LAST_RULES,
    *catalogue_rules.LAST_RULES,
    *series_rules.RULES,
    *series_rules.LAST_RULES,
)
