"""Random generators that depend on what they are for, not on what was drawn before."""

from __future__ import annotations

import hashlib
from typing import Any

import numpy as np

from llm3.jsonio import dumps


def derive_seed(*parts: Any) -> int:
    """A 64-bit seed from JSON-safe parts; the same in every process and on every machine."""
    digest = hashlib.blake2b(dumps(parts).encode(), digest_size=8).digest()
    return int.from_bytes(digest, "big")


def generator(*parts: Any) -> np.random.Generator:
    """A generator seeded by its purpose, such as ``generator(run_seed, state, action, attempt)``."""
    return np.random.default_rng(derive_seed(*parts))
