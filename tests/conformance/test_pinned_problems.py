"""Problems of which figures are published stay what they are: a change that draws others needs other names for them."""

from __future__ import annotations

import hashlib

import pytest

from llm3.jsonio import dumps
from llm3.registry import Registry

DIGESTS = {
    "boxpack/dense-6": "3464efa1",
    "boxpack/dense-8": "314adc82",
    "boxpack/dense-10": "4e169384",
    "boxpack/dense-12": "91b977ab",
    "boxpack/far-4": "716c1478",
    "boxpack/far-8": "445bef7f",
    "boxpack/clutter-4": "802d2865",
    "boxpack/clutter-8": "e03f015e",
    "boxpack/lanes-4": "4c469c8b",
    "boxpack/lanes-8": "879505d5",
    "blocks/blocks-8": "43c77a51",
    "blocks/blocks-10": "dace87f9",
    "blocks/rebuild-6": "d3ed431d",
    "blocks/rebuild-8": "6ab4935d",
    "blocks/rebuild-10": "6f98cbd6",
    "kitchen/kitchen-8": "978cd3fa",
    "kitchen/kitchen-10": "cb8dfe34",
    "kitchen/cramped-4": "9aa07cb8",
    "kitchen/cramped-6": "d64a27c0",
    "kitchen/cramped-8": "1fff2771",
}


def digest(domain: str, setting: str) -> str:
    made = Registry.discover().domain(domain)
    text = "".join(dumps(made.instance(setting, seed)) for seed in (0, 1000))
    return hashlib.blake2b(text.encode(), digest_size=4).hexdigest()


@pytest.mark.pybullet
@pytest.mark.parametrize("name", DIGESTS)
def test_the_problems_are_what_they_were(name):
    assert digest(*name.split("/")) == DIGESTS[name]


@pytest.mark.pybullet
def test_every_setting_that_is_made_from_a_solution_is_pinned():
    registry = Registry.discover()
    made = {
        f"{name}/{setting}"
        for name in registry.names("domain")
        for setting in registry.domain(name).settings
        if registry.domain(name).witness(setting, 0) is not None
    }
    assert made == set(DIGESTS)
