"""Many episodes against a model server that misbehaves, and what became of each.

    python tests/chaos/chaos.py --episodes 200

The HTTP backend, the loop, the planner and the records are the real ones; the waits between retries take no time.
"""

from __future__ import annotations

import argparse
import json
import os
import stat
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path

import numpy as np
import requests
from chaos_report import KINDS, Episode, Report

from llm3 import BackendSettings, Registry, RunConfig, assemble
from llm3.errors import BackendError
from llm3.records import Recorder, create_folder
from llm3.testing import Faults, LLMServer
from llm3.types import Completion, Request
from llm3_http.backend import HttpBackend
from llm3_http.presets import Preset
from llm3_http.settings import HttpSettings

CORRIDOR = Path(__file__).resolve().parents[1] / "third_party" / "llm3_corridor"
DOMAINS = ("boxpack", "corridor")
ANSWER_TIME = 0.3
"""Seconds in which the server has to answer: what a timeout costs."""


def chaos(episodes: int, domains: Sequence[str], folder: Path, seed: int = 0, rate: float = 0.2) -> Report:
    """Run the episodes, the domains in turn.

    Args:
        episodes: How many.
        domains: Their names.
        folder: For the records.
        seed: Of the first problem, and of the faults.
        rate: The share of the answers that go wrong.
    """
    registry = registry_with_corridor()
    before = alive()
    served = Faults.at_rate(rate, KINDS, np.random.default_rng(seed))
    done: list[Episode] = []
    with LLMServer(_stand_ins(registry, domains), faults=served, refuses=["json_schema"]) as server:
        for number in range(episodes):
            round_, turn = divmod(number, len(domains))
            config = _config(domains[turn], seed + round_)
            done.append(_episode(registry, server, config, folder / f"{number:04}"))
    return Report(tuple(done), len(server.answers), tuple(sorted(alive() - before)))


def _config(domain: str, seed: int) -> RunConfig:
    """Most budgets are of calls alone; some are of tokens or of time as well, and too small for most problems."""
    limits = {3: {"max_tokens_total": 4_000}, 7: {"max_seconds": 0.4}}.get(seed % 10, {})
    return RunConfig(domain, seed=seed, timing="none", max_llm_calls=8, **limits)


def _episode(registry: Registry, server: LLMServer, config: RunConfig, folder: Path) -> Episode:
    first = len(server.answers)
    result = None
    with assemble(registry, replace(config, llm="offline")) as assembled, _backend(server.url, config.seed) as backend:
        solver = replace(assembled.solver, backend=server.tap(backend))
        run = replace(assembled, solver=solver, config=config)
        try:
            with Recorder(create_folder(folder), run) as record:
                result = run.solve(record)
        except BackendError:
            pass  # it stands in the record
    events = (folder / "events.jsonl").read_text(encoding="utf-8").splitlines()
    return Episode(
        config.domain,
        config,
        tuple(server.answers[first:]),
        json.loads((folder / "run.json").read_text(encoding="utf-8")),
        tuple(json.loads(line) for line in events[1:]),
        result,
    )


@contextmanager
def _backend(url: str, seed: int) -> Iterator[HttpBackend]:
    settings = HttpSettings("chaos", Preset(url), read_timeout=ANSWER_TIME)
    backend = HttpBackend(settings, rng=np.random.default_rng(seed), session_factory=_session, sleep=lambda _: None)
    try:
        yield backend
    finally:
        backend.close()


def _session() -> requests.Session:
    session = requests.Session()
    session.trust_env = False  # no proxy of this machine
    return session


def _stand_ins(registry: Registry, domains: Sequence[str]) -> Callable[[Request], Completion]:
    """The script: each domain's stand-in, or random parameters where it has none."""
    writers = {}
    for name in domains:
        domain = registry.domain(name)
        instance = domain.instance(domain.default_setting, 0)
        settings = BackendSettings(name, stand_in=domain.stand_in(), skeleton=domain.skeleton(instance))
        env = domain.make(instance, {option.name: option.default for option in domain.options})
        writers[env.task] = registry.backend("offline", settings)
        env.close()

    def script(request: Request) -> Completion:
        return writers[request.context.task].complete(request)

    return script


def registry_with_corridor() -> Registry:
    registry = Registry.discover()
    if "corridor" not in registry.names("domain"):
        sys.path.insert(0, str(CORRIDOR))
        try:
            import llm3_corridor
        finally:
            sys.path.remove(str(CORRIDOR))
        registry.register(llm3_corridor, "corridor")
    return registry


def alive() -> set[str]:
    """Threads and open sockets."""
    found = {f"thread {thread.name}" for thread in threading.enumerate()}
    for descriptor in Path("/dev/fd").iterdir():
        with suppress(OSError):  # the one that lists them is gone by now
            if stat.S_ISSOCK(os.fstat(int(descriptor.name)).st_mode):
                found.add(f"socket {descriptor.name}")
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--episodes", type=int, default=200)
    parser.add_argument("--domains", nargs="+", default=list(DOMAINS))
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        report = chaos(arguments.episodes, arguments.domains, Path(folder), arguments.seed)
    sys.stdout.write(f"{report}\n")


if __name__ == "__main__":
    main()
