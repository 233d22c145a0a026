"""Packages to begin with: a plugin of each kind that works, as files that somebody can change."""

from llm3.scaffold.kinds import BULLET_DOMAIN, KINDS, Kind
from llm3.scaffold.name import Name
from llm3.scaffold.package import render, write

__all__ = ["BULLET_DOMAIN", "KINDS", "Kind", "Name", "render", "write"]
