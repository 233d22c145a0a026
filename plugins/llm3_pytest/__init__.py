"""Fixtures for tests of domains, planners and backends: ``scripted_llm``, ``llm3_registry`` and ``llm_server``.

pytest imports this package in every test suite of an environment in which llm3 is installed, also in those that do
not use it. So nothing of llm3 is imported before a fixture is asked for, and nothing is but the fixtures.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from llm3 import Registry
    from llm3.testing import LLMServer, ScriptedLLM


@pytest.fixture
def scripted_llm() -> type[ScriptedLLM]:
    """Makes a fake model of a script: ``scripted_llm([reply, reply])``; see `llm3.testing.ScriptedLLM`."""
    from llm3.testing import ScriptedLLM

    return ScriptedLLM


@pytest.fixture
def llm3_registry() -> Registry:
    """All installed plugins. It is made anew for each test, which may register its own."""
    from llm3 import Registry

    return Registry.discover()


@pytest.fixture
def llm_server() -> Iterator[Callable[..., LLMServer]]:
    """Starts a model server: ``llm_server([reply, reply], faults=...)``; see `llm3.testing.LLMServer`.

    It is closed at the end of the test. There may be several.
    """
    from llm3.testing import LLMServer

    with ExitStack() as running:
        yield lambda *script, **arguments: running.enter_context(LLMServer(*script, **arguments))
