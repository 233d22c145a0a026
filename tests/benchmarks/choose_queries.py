"""Choose the forty queries anew, and write them to queries.json.

    OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 python tests/benchmarks/choose_queries.py

They are transits as `BoxpackEnv.prepare` asks for them, in the states that runs of the offline and of the random
stand-in come through. Almost all such transits are free along the straight line, so a plain draw would say nothing
about the search. The forty are stratified: the gripper holds a box in half of them, and of each half three quarters
are free along the straight line and a quarter is not. Within a stratum the settings take turns, each with its queries
in the order in which the runs met them. The file also says how many transits of each stratum were met.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import chain, zip_longest

import numpy as np
from queries import FILE, Queries, Query

from llm3.assembly import RunConfig, assemble
from llm3.interfaces import FreeSpace
from llm3.jsonio import dumps
from llm3.registry import Registry
from llm3.seeding import generator
from llm3.types import Action, ActionTried, MotionProblem, RunEvent, State
from llm3_boxpack.env import BoxpackEnv
from llm3_boxpack.paper_settings import SETTINGS, generate
from llm3_bullet.robots.panda import panda
from llm3_bullet.workcell import Workcell

SEEDS = range(4)
STAND_INS = (("offline", "backtrack"), ("random", "sample-params"))
"""Each with the prompt strategy that goes with it."""
MODEL_CALLS = 10
"""Attempts of a run at most."""
STRATA = {"empty, straight": 15, "empty, winding": 5, "holding, straight": 15, "holding, winding": 5}
"""How many queries of each."""


def stratum(query: Query) -> str:
    """Whether a box is held, and whether the straight line is blocked."""
    return f"{'holding' if query.scene.held else 'empty'}, {'winding' if query.winding else 'straight'}"


def choose(by_setting: Iterable[Iterable[Query]]) -> Queries:
    """The settings take turns within each stratum."""
    by_turns = [query for query in chain.from_iterable(zip_longest(*by_setting)) if query is not None]
    members = {name: [query for query in by_turns if stratum(query) == name] for name in STRATA}
    chosen = chain.from_iterable(members[name][:number] for name, number in STRATA.items())
    return Queries(dict(Counter(map(stratum, by_turns))), tuple(chosen))


def transits(registry: Registry, setting: str, seed: int, cell: Workcell) -> Iterator[Query]:
    """All transits of the runs with this setting and seed, each once."""
    env = BoxpackEnv(generate(setting, seed), cell)
    for state, action in tried(registry, setting, seed):
        problem = env.prepare(state, action, generator("benchmark", setting, seed, state, action))
        if isinstance(problem, MotionProblem):
            start, goal = tuple(problem.start.tolist()), problem.goals[0].configuration
            winding = not FreeSpace(problem).path(np.array([start, goal]))
            yield Query(setting, seed, str(action), env.scene(state), start, goal, winding)


def tried(registry: Registry, setting: str, seed: int) -> Iterable[tuple[State, Action]]:
    """Every action that the runs tried, with the state before it."""
    found: dict[tuple[State, Action], None] = {}

    def observer(event: RunEvent) -> None:
        if isinstance(event, ActionTried) and isinstance(event.outcome.action, Action):
            found[event.before, event.outcome.action] = None

    for llm, strategy in STAND_INS:
        config = RunConfig("boxpack", setting, seed, strategy, llm=llm, max_llm_calls=MODEL_CALLS)
        with assemble(registry, config) as run:
            run.solve(observer)
    return found


def main() -> None:
    """Write the file."""
    registry, cell = Registry.discover(), Workcell(panda())
    met = [[query for seed in SEEDS for query in transits(registry, setting, seed, cell)] for setting in SETTINGS]
    FILE.write_text(dumps(choose(met)) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
