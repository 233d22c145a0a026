"""Discs and boxes on a table, seen from above: a domain without a simulator, for tutorials and tests."""
