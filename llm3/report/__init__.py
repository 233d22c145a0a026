"""Pages that tell what happened: one HTML file each, which needs no network."""

from llm3.report.changes import Line, changes
from llm3.report.experiment_report import PAGE, experiment_report, recorded_runs
from llm3.report.run_report import Report, run_report
from llm3.report.story import Story, Turn, read_story

__all__ = [
    "PAGE",
    "Line",
    "Report",
    "Story",
    "Turn",
    "changes",
    "experiment_report",
    "read_story",
    "recorded_runs",
    "run_report",
]
