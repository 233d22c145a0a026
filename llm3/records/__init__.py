"""What a run leaves on disk, and how it is read and repeated."""

from llm3.records.cassette import CassetteRecorder, check_cassette, read_cassette
from llm3.records.event_reader import RecordedEvent, read_events
from llm3.records.exchange import Exchange, RecordedReply, RecordedRequest, Usage
from llm3.records.folder import create_default_folder, create_folder
from llm3.records.pairing import read_exchanges
from llm3.records.plan import PlanFile, open_plan, read_plan
from llm3.records.played import Played, played_of, read_played
from llm3.records.recorder import Recorder
from llm3.records.repetition import repeat
from llm3.records.run_file import RunFile, read_run

__all__ = [
    "CassetteRecorder",
    "Exchange",
    "PlanFile",
    "Played",
    "RecordedEvent",
    "RecordedReply",
    "RecordedRequest",
    "Recorder",
    "RunFile",
    "Usage",
    "check_cassette",
    "create_default_folder",
    "create_folder",
    "open_plan",
    "played_of",
    "read_cassette",
    "read_events",
    "read_exchanges",
    "read_plan",
    "read_played",
    "read_run",
    "repeat",
]
