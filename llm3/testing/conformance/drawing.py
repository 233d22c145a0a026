"""Actions to try, drawn one by one: with many objects there are too many to write them all down."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from llm3.interfaces import Env, Regions, drawn, sampling_ranges
from llm3.types import Action, ActionSchema, Sketch, State

HELD = 0.5
"""How often an action takes what is held, if it takes objects and something is held."""


@dataclass(frozen=True)
class Drawing:
    """Draws actions of a world."""

    env: Env
    regions: Regions
    """Where parameters are drawn."""
    rng: np.random.Generator

    @property
    def schemas(self) -> tuple[ActionSchema, ...]:
        """The actions for which there are objects."""
        return tuple(schema for schema in self.env.schemas if self.env.objects or not schema.objects)

    @property
    def moves(self) -> int:
        """How many actions there are, whatever their parameters."""
        return sum(len(self.env.objects) ** len(schema.objects) for schema in self.env.schemas)

    def one(self, schema: ActionSchema, state: State) -> Action:
        """An action of this kind, with what is held among its objects now and then."""
        names = self._names(schema)
        held = state.held.object if state.held else None
        if names and held in self.env.objects and self.rng.random() < HELD:
            names[self.rng.integers(len(names))] = str(held)
        return self._action(schema, names)

    def some(self, state: State, count: int) -> Iterator[Action]:
        """So many actions of each kind."""
        for schema in self.schemas:
            for _ in range(count):
                yield self.one(schema, state)

    def each(self, seen: set[tuple[str, int, str]]) -> Iterator[Action]:
        """Actions in which each object stands at each place of each kind of action, in some company.

        Args:
            seen: What stood at which place already; it is filled.
        """
        places = [(s, i, name) for s in self.schemas for i in range(len(s.objects)) for name in self.env.objects]
        for number in self.rng.permutation(len(places)):
            schema, place, name = places[number]
            if (schema.name, place, name) in seen:
                continue
            names = self._names(schema)
            for other in range(len(names)):  # the company is new, too, where that can be
                new = [n for n in self.env.objects if (schema.name, other, n) not in seen]
                names[other] = new[self.rng.integers(len(new))] if new else names[other]
            names[place] = name
            action = self._action(schema, names)
            seen |= places_of(action)
            yield action

    def with_held(self, schema: ActionSchema, state: State) -> Iterator[Action]:
        """Actions of a kind with what is held at each place, and each object at each other place in turn."""
        held = state.held.object if state.held else None
        slots = range(len(schema.objects) if held in self.env.objects else 0)
        ways = [(mine, other, name) for mine in slots for other in slots for name in self.env.objects]
        for number in self.rng.permutation(len(ways)):
            mine, other, name = ways[number]
            names = self._names(schema)
            names[other] = name
            names[mine] = str(held)
            yield self._action(schema, names)

    def at_the_ends(self, action: Action) -> Iterator[Action]:
        """The action with each parameter at an end of its range, and with each at the other."""
        parameters = next(schema.parameters for schema in self.env.schemas if schema.name == action.name)
        highs = self.rng.integers(2, size=len(parameters))
        for flip in (0, 1) if parameters else ():
            pairs = zip(parameters, highs, strict=True)
            yield replace(action, params={p.name: p.high if high != flip else p.low for p, high in pairs})

    def _names(self, schema: ActionSchema) -> list[str]:
        return [self.env.objects[self.rng.integers(len(self.env.objects))] for _ in schema.objects]

    def _action(self, schema: ActionSchema, names: list[str]) -> Action:
        objects = tuple(names)
        return drawn(Sketch(schema.name, objects), sampling_ranges(schema, objects, self.regions), self.rng)


def places_of(action: Action) -> set[tuple[str, int, str]]:
    """Which object stands at which place of which kind of action."""
    return {(action.name, place, name) for place, name in enumerate(action.objects)}
