"""Uniform random parameters over an action sequence: the random row of the paper's Table II."""

from __future__ import annotations

import json

import numpy as np

from llm3 import BackendSettings, LLMBackend
from llm3.errors import MissingCapability
from llm3.interfaces import drawn, sampling_ranges
from llm3.types import Completion, Request


class RandomBackend(LLMBackend):
    """Fills the domain's action sequence with parameters drawn uniformly.

    Each is drawn from its range in the schema or, where the domain names one, from a tighter region. Where the prompt
    gives no sequence and the domain tells of what pieces one consists, the order of the pieces is drawn as well.
    """

    def __init__(self, settings: BackendSettings, notice: str = "") -> None:
        """Take the domain's sequence and regions.

        Args:
            settings: What the domain offers.
            notice: What to tell the user instead of the usual line.

        Raises:
            MissingCapability: The domain gives neither an action sequence nor pieces of one.
        """
        if not settings.skeleton and not settings.pieces:
            raise MissingCapability(settings.domain, "skeleton", "the backend 'random'")
        self._pieces = settings.pieces or (settings.skeleton,)
        self._regions = settings.regions
        self._notice = notice or "No language model is used: the parameters are drawn at random."

    @property
    def is_language_model(self) -> bool:
        """It is none."""
        return False

    @property
    def notice(self) -> str:
        """Says so."""
        return self._notice

    def complete(self, request: Request) -> Completion:
        """The sequence with fresh parameters."""
        rng = np.random.default_rng(request.seed)
        schemas = {schema.name: schema for schema in request.context.actions}
        given = request.context.skeleton
        sequence = given or [sketch for piece in rng.permutation(len(self._pieces)) for sketch in self._pieces[piece]]
        plan = [
            str(drawn(sketch, sampling_ranges(schemas[sketch.name], sketch.objects, self._regions), rng))
            for sketch in sequence
        ]
        return Completion(json.dumps({"Reasoning": "The parameters are drawn at random.", "Full Plan": plan}))
