"""Plays what a run did: as moments, on a domain's stage while it happens, as films, and in three dimensions."""

from llm3.playback.evidence import Evidence, Touch, evidence, touching
from llm3.playback.frames import Frame, evenly, frames
from llm3.playback.from_above import View, seen_from_above
from llm3.playback.live import Live
from llm3.playback.projected import open_view
from llm3.playback.replay import Chapter, replay_page
from llm3.playback.stages import open_scenery, open_stage, open_window

__all__ = [
    "Chapter",
    "Evidence",
    "Frame",
    "Live",
    "Touch",
    "View",
    "evenly",
    "evidence",
    "frames",
    "open_scenery",
    "open_stage",
    "open_view",
    "open_window",
    "replay_page",
    "seen_from_above",
    "touching",
]
