"""The page of rules holds each rule that the kit looks at."""

from __future__ import annotations

import importlib.util

from docs_pages import DOCS, page

from llm3.cli.check_command import KINDS
from llm3.testing.conformance.laws import laws


def rules_script():
    spec = importlib.util.spec_from_file_location("docs_rules", DOCS / "rules.py")
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_has_every_rule_with_its_law():
    text = page("rules")
    assert rules_script().with_rules(text) == text, "run docs/rules.py"
    assert tuple(laws()) == KINDS
    for law in (law for of_kind in laws().values() for law in of_kind):
        assert f"| {law.name} | {law.text} |" in text
        assert law.text.endswith(".")
