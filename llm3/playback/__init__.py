"""Plays what a run did: as moments, on a domain's stage while it happens, and as films."""

from llm3.playback.frames import Frame, evenly, frames
from llm3.playback.from_above import seen_from_above
from llm3.playback.live import Live
from llm3.playback.replay import Mark, replay_page
from llm3.playback.stages import open_scenery, open_stage, open_window

__all__ = [
    "Frame",
    "Live",
    "Mark",
    "evenly",
    "frames",
    "open_scenery",
    "open_stage",
    "open_window",
    "replay_page",
    "seen_from_above",
]
