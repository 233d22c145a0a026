"""What a run leaves on disk: run.json, events.jsonl and plan.json."""

from llm3.records.folder import create_default_folder, create_folder
from llm3.records.plan import PlanFile, open_plan, read_plan
from llm3.records.recorder import Recorder, RunFile

__all__ = ["PlanFile", "Recorder", "RunFile", "create_default_folder", "create_folder", "open_plan", "read_plan"]
