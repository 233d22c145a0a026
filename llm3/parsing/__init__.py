"""From the text of a model to a plan: no reply raises, and reading time grows linearly with its length.

::

    text ─ search ─→ answer ─ drafts ─→ drafts ─ checks ─→ actions ─ sequence ─→ Proposal
             │ reader, tokens: one tolerant grammar for JSON, Python literals and calls
             └ mending: what is tried when nothing can be read

Whatever is wrong becomes a sentence for the model; they all stand in `sentences`.
"""

from llm3.parsing.reply import parse_reply
from llm3.parsing.schema import reply_schema

__all__ = ["parse_reply", "reply_schema"]
