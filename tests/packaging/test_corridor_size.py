"""A domain of one's own is short."""

from __future__ import annotations

import ast

from command_line import CORRIDOR


def test_the_corridor_is_about_forty_statements():
    tree = ast.parse((CORRIDOR / "llm3_corridor.py").read_text(encoding="utf-8"))
    statements = [node for node in ast.walk(tree) if isinstance(node, ast.stmt)]
    docstrings = [node for node in statements if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)]
    assert len(statements) - len(docstrings) <= 45
