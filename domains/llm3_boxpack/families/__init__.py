"""Problems that are made from a solution: each family draws a packing that the hand can do, and then how it begins."""

from llm3_boxpack.families.catalogue import FAMILIES, drafted
from llm3_boxpack.families.draft import Draft

__all__ = ["FAMILIES", "Draft", "drafted"]
