"""Whether a server read the whole prompt."""

from __future__ import annotations

import re
from collections.abc import Iterable

from llm3.errors import BackendError
from llm3.types import Message
from llm3_http.settings import HttpSettings

LONG = 6000
"""Words of a long prompt: four times the words and numbers in the longest prompts of the box-packing task."""


def least_tokens(messages: Iterable[Message]) -> int:
    """How many tokens messages have at least, whatever the model.

    Tokenizers do not join words, nor numbers, across what stands between them: so there are at least as many tokens
    as words and numbers. English prose has some 1.3 tokens to a word. In the prompts of the box-packing task a word
    or a number takes 5.8 characters with what stands around it.
    """
    return sum(len(re.findall(r"[\w'’]+", message.content)) for message in messages)


def check_whole(messages: Iterable[Message], prompt_tokens: int, settings: HttpSettings) -> None:
    """Let pass what can have been read as a whole.

    Args:
        messages: What was sent.
        prompt_tokens: How many tokens the server says that it read; 0 if it does not say.
        settings: For the server's ways, and the sentence.

    Raises:
        BackendError: A server that cuts prompts off in silence read fewer tokens than there are words.
    """
    least = least_tokens(messages)
    if settings.preset.cuts_long_prompts and 0 < prompt_tokens < least:
        raise BackendError(
            f"the server at {settings.base_url} read {prompt_tokens} tokens of a prompt that has {least} at least, and "
            "so cut it off: let it have a larger context (OLLAMA_CONTEXT_LENGTH for Ollama), "
            "or give a smaller --trace-size"
        )
