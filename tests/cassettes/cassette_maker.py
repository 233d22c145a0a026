"""Makes cassettes of conversations that nobody had."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from llm3.assembly import Loop, Run, RunConfig
from llm3.interfaces import LLMBackend
from llm3.records import CassetteRecorder
from llm3.testing import ScriptedLLM
from llm3.types import CallFailed, Completion, Message, PromptSent, ReplyReceived, Stats

CONFIG = RunConfig("corridor", "default", 7, model="gpt", temperature=0, max_reply_tokens=99)


class Model(ScriptedLLM):
    """Says that it is a language model."""

    @property
    def is_language_model(self):
        return True


def run_of(config: RunConfig = CONFIG, backend: LLMBackend | None = None) -> Run:
    """A run of which nothing but the names is looked at."""
    return Run(config, None, Loop(backend or ScriptedLLM([]), None, None), None)


def tape(
    path: Path,
    conversation: Iterable[tuple[tuple[Message, ...], Completion | str]],
    config: RunConfig = CONFIG,
    force: bool = False,
    backend: LLMBackend | None = None,
) -> Path:
    """Record prompts and what came of them, a completion or an error."""
    with CassetteRecorder(path, run_of(config, backend), force, clock=iter(range(10_000)).__next__) as observe:
        for number, (asked, answer) in enumerate(conversation, start=1):
            observe(PromptSent(number, asked))
            failed = isinstance(answer, str)
            observe(CallFailed(number, answer, Stats(retries=3)) if failed else ReplyReceived(number, answer))
    return path
