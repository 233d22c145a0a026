"""A bounded, seeded search for actions that are worth a look: some that work, some that do not, of every kind."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

import numpy as np

from llm3.budget import Budget
from llm3.search import search
from llm3.search.moves import Move, moves_of
from llm3.seeding import generator
from llm3.solve import solve
from llm3.testing.conformance.helpers import STRATEGY
from llm3.testing.conformance.inspection import Inspection
from llm3.testing.conformance.world import World, spread, tried
from llm3.testing.scripted import ScriptedLLM, stand_in_script
from llm3.types import Action, ActionTried, RunEvent, Sketch, State

LED = Budget(max_llm_calls=10, max_motion_calls=100)
"""What a domain's stand-in may spend."""
SEARCHED = Budget(max_motion_calls=40)
"""What a search may spend."""
WORKED, FAILED = 3, 2
"""How many actions of each kind are taken over from those."""
AT_START, LATER = 4, 2
"""How many actions of each kind are drawn in the initial state, and in each of some later ones."""
EACH = 40
"""How many actions are drawn, at most, so that each object stands once at each place of each kind of action."""
STATES = 3
"""How many later states."""
PATIENCE = 30
"""How many more are drawn for a kind that was never carried out, or never refused."""

Pair = tuple[State, Action]


def explore(world: World, inspection: Inspection) -> None:
    """Try actions, and keep what became of them in the world; what raises is a complaint, and the rest goes on."""
    where = f"{world.setting}, seed {world.seed}"
    rng = generator("explore", world.setting, world.seed)
    moves = tuple(moves_of(world.env, world.regions))

    def attempt(pairs: Iterator[Pair] | list[Pair]) -> None:
        for state, action in pairs:
            if any((t.state, t.action) == (state, action) for t in world.trials):
                continue
            inspection.actions += 1
            try:
                trial = tried(world, state, action)
            except (Exception, SystemExit) as error:
                inspection.raised(error, f"{where}, {action}")
                continue
            inspection.applied += trial.transition is not None
            world.trials.append(trial)

    attempt(_drawn(moves, [world.start], AT_START, rng))
    attempt(islice(_each(world, moves, rng), EACH))
    watch = _Watch()
    try:
        _solved(world, watch)
    except (Exception, SystemExit) as error:
        world.errors.append(error)
    attempt(watch.chosen())
    attempt(_drawn(moves, watch.states(world.start), LATER, rng))
    states = [world.start, *watch.states(world.start)]
    for name in dict.fromkeys(move.sketch.name for move in moves):
        of_kind = [move for move in moves if move.sketch.name == name]
        for _ in range(PATIENCE):
            trials = [trial for trial in world.trials if trial.action.name == name]
            if any(t.failure for t in trials) and any(t.transition is not None for t in trials):
                break
            state = states[rng.integers(len(states))]
            attempt([(state, of_kind[rng.integers(len(of_kind))].drawn(rng))])


def _each(world: World, moves: tuple[Move, ...], rng: np.random.Generator) -> Iterator[Pair]:
    """In the initial state, each object at each place of each kind of action where it was not yet, in some company."""
    seen = {place for trial in world.trials for place in _places(trial.action)}
    for number in rng.permutation(len(moves)):
        move = moves[number]
        if not _places(move.sketch) <= seen:
            seen |= _places(move.sketch)
            yield world.start, move.drawn(rng)


def _places(of: Action | Sketch) -> set[tuple[str, int, str]]:
    return {(of.name, place, name) for place, name in enumerate(of.objects)}


def _drawn(moves: tuple[Move, ...], states: list[State], count: int, rng: np.random.Generator) -> Iterator[Pair]:
    """Some actions of each kind in each of the states."""
    for state in states:
        for name in dict.fromkeys(move.sketch.name for move in moves):
            of_kind = [move for move in moves if move.sketch.name == name]
            for _ in range(count):
                yield state, of_kind[rng.integers(len(of_kind))].drawn(rng)


def _solved(world: World, watch: _Watch) -> None:
    """Let the domain's stand-in solve the problem, and a search where there is none or it does not; and watch."""
    helpers, stand_in = world.helpers, world.domain.stand_in()
    if helpers.planner is None:
        return
    prompt = helpers.prompts.get(STRATEGY)
    if stand_in is not None and helpers.feedback and prompt:
        result = solve(
            world.env,
            backend=ScriptedLLM(stand_in_script(stand_in)),
            planner=helpers.planner,
            feedback=helpers.feedback,
            prompt=prompt,
            budget=LED,
            observer=watch,
        )
        world.result = result if result.solved else None
    if world.result is None:
        found = search(world.env, planner=helpers.planner, regions=world.regions, budget=SEARCHED, observer=watch)
        world.result = found if found.solved else None


class _Watch:
    """Keeps what a run tries."""

    def __init__(self) -> None:
        self._worked: list[Pair] = []
        self._failed: list[Pair] = []
        self._after: dict[State, None] = {}

    def __call__(self, event: RunEvent) -> None:
        """Is told of everything."""
        if isinstance(event, ActionTried) and isinstance(event.outcome.action, Action):
            kept = self._worked if event.step else self._failed
            kept.append((event.before, event.outcome.action))
            if event.step:
                self._after.setdefault(event.step.state)

    def chosen(self) -> list[Pair]:
        """Some of each kind of action that worked, and of each that failed."""
        return [*_some(self._worked, WORKED), *_some(self._failed, FAILED)]

    def states(self, start: State) -> list[State]:
        """Some states that were reached, spread over the run."""
        return spread([state for state in self._after if state != start], STATES)


def _some(pairs: list[Pair], count: int) -> Iterator[Pair]:
    kinds: dict[str, list[Pair]] = {}
    for pair in dict.fromkeys(pairs):
        kinds.setdefault(pair[1].name, []).append(pair)
    for of_kind in kinds.values():
        yield from spread(of_kind, count)
