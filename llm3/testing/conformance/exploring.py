"""A bounded, seeded search for actions that are worth a look: some that work, some that do not, of every kind."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice

from llm3.budget import Budget
from llm3.jsonio import dumps
from llm3.search import search
from llm3.seeding import generator
from llm3.solve import solve
from llm3.testing.conformance.drawing import Drawing, places_of
from llm3.testing.conformance.helpers import STRATEGY
from llm3.testing.conformance.inspection import Inspection
from llm3.testing.conformance.world import World, spread, tried
from llm3.testing.scripted import ScriptedLLM, stand_in_script
from llm3.types import Action, ActionTried, Result, RunEvent, State

LED = Budget(max_llm_calls=10, max_motion_calls=100)
"""What a domain's stand-in may spend."""
SEARCHED = Budget(max_motion_calls=40)
"""What a search may spend."""
HURRIED = Budget(max_llm_calls=3, max_motion_calls=10, max_seconds=20)
"""What either may spend where each answer takes long."""
MOVES = 5000
"""Among more actions than these no search finds a plan with so little, and it would take long to begin."""
WORKED, FAILED = 3, 2
"""How many actions of each kind are taken over from those."""
AT_START, LATER = 4, 2
"""How many actions of each kind are drawn in the initial state, and in each of some later ones."""
EACH, EACH_LATER = 40, 10
"""How many actions are drawn, at most, so that each object stands once at each place of each kind of action."""
STATES = 3
"""How many later states."""
PATIENCE = 30
"""How many more are drawn for a kind that was never carried out, or never refused."""
HELD = 100
"""How many more with what is held are drawn, at most, for a kind that was never carried out."""

Pair = tuple[State, Action]


def explore(world: World, inspection: Inspection) -> None:
    """Try actions, and keep what became of them in the world; so is what was raised, and the rest goes on."""
    draw = Drawing(world.env, world.regions, generator("explore", world.setting, world.seed))
    done: set[Pair] = set()

    def attempt(pairs: Iterable[Pair]) -> None:
        for state, action in pairs:
            if (state, action) in done:
                continue
            done.add((state, action))
            inspection.actions += 1
            try:
                trial = tried(world, state, action)
            except (Exception, SystemExit) as error:
                world.raised.append(error)
                continue
            inspection.applied += trial.transition is not None
            world.trials.append(trial)

    def each(state: State, count: int) -> Iterator[Pair]:
        seen = {place for before, action in done if before == state for place in places_of(action)}
        return ((state, action) for action in islice(draw.each(seen), world.bounded(count)))

    attempt((world.start, action) for action in draw.some(world.start, AT_START))
    attempt(each(world.start, EACH))
    watch = _Watch()
    try:
        _solved(world, draw, watch)
    except (Exception, SystemExit) as error:
        world.errors.append(error)
    attempt(watch.chosen())
    later = watch.states(world.start)
    attempt((state, action) for state in later for action in draw.some(state, LATER))
    telling = _telling([*later, *watch.after, *world.states], world.start)
    for state in telling:
        attempt(each(state, EACH_LATER))
    for schema in draw.schemas:
        of_kind = [trial for trial in world.trials if trial.action.name == schema.name]
        best = next((t for t in of_kind if t.transition is not None), of_kind[0] if of_kind else None)
        if best is not None:
            attempt((best.state, action) for action in draw.at_the_ends(best.action))
    for schema in draw.schemas:
        for state in telling:
            for action in islice(draw.with_held(schema, state), world.bounded(HELD)):
                if any(trial.action.name == schema.name for trial in world.applied):
                    break
                attempt([(state, action)])
    states = [world.start, *later]
    for schema in draw.schemas:
        for _ in range(world.bounded(PATIENCE)):
            of_kind = [trial for trial in world.trials if trial.action.name == schema.name]
            if any(t.failure for t in of_kind) and any(t.transition is not None for t in of_kind):
                break
            state = states[draw.rng.integers(len(states))]
            attempt([(state, draw.one(schema, state))])


def _telling(states: list[State], start: State) -> list[State]:
    """A state in which something is held, and one in which a fact differs."""
    holding = next((state for state in states if state.held and state.held != start.held), None)
    changed = next((state for state in states if state.facts != start.facts), None)
    return list(dict.fromkeys(state for state in (holding, changed) if state is not None))


def _solved(world: World, draw: Drawing, watch: _Watch) -> None:
    """Let the domain's stand-in solve the problem; where it does not, its witness, or else a search; and watch."""
    helpers, stand_in = world.helpers, world.domain.stand_in()
    if helpers.planner is None:
        return
    if stand_in is not None:
        result = _told(world, ScriptedLLM(stand_in_script(stand_in)), HURRIED if world.slow else LED, watch)
        if result is not None:
            world.led, world.unmet = result.solved, result.goal.unmet
            world.result = result if result.solved else None
    witness = world.witness
    if world.result is None and witness:
        reply = dumps({"Full Plan": [str(action) for action in witness]})
        result = _told(world, ScriptedLLM([reply]), Budget(max_llm_calls=1), watch)
        world.result = result if result and result.solved else None
    elif world.result is None and draw.moves <= MOVES:
        budget = HURRIED if world.slow else SEARCHED
        found = search(
            world.env,
            planner=helpers.planner,
            regions=world.regions,
            budget=budget,
            observer=watch,
            clock=world.clock,
        )
        world.result = found if found.solved else None


def _told(world: World, backend: ScriptedLLM, budget: Budget, watch: _Watch) -> Result | None:
    """A run in which a backend is asked; None where what it takes cannot be had."""
    helpers = world.helpers
    prompt = helpers.prompts.get(STRATEGY)
    if helpers.planner is None or helpers.feedback is None or prompt is None:
        return None
    return solve(
        world.env,
        backend=backend,
        planner=helpers.planner,
        feedback=helpers.feedback,
        prompt=prompt,
        budget=budget,
        observer=watch,
        clock=world.clock,
    )


class _Watch:
    """Keeps what a run tries."""

    def __init__(self) -> None:
        self._worked: list[Pair] = []
        self._failed: list[Pair] = []
        self.after: dict[State, None] = {}

    def __call__(self, event: RunEvent) -> None:
        """Is told of everything."""
        if isinstance(event, ActionTried) and isinstance(event.outcome.action, Action):
            kept = self._worked if event.step else self._failed
            kept.append((event.before, event.outcome.action))
            if event.step:
                self.after.setdefault(event.step.state)

    def chosen(self) -> list[Pair]:
        """Some of each kind of action that worked, and of each that failed."""
        return [*_some(self._worked, WORKED), *_some(self._failed, FAILED)]

    def states(self, start: State) -> list[State]:
        """Some states that were reached, spread over the run."""
        return spread([state for state in self.after if state != start], STATES)


def _some(pairs: list[Pair], count: int) -> Iterator[Pair]:
    kinds: dict[str, list[Pair]] = {}
    for pair in dict.fromkeys(pairs):
        kinds.setdefault(pair[1].name, []).append(pair)
    for of_kind in kinds.values():
        yield from spread(of_kind, count)
