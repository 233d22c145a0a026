"""Pages that tell what happened: one HTML file each, which needs no network."""

from llm3.report.experiment_report import PAGE, experiment_report, recorded_runs
from llm3.report.run_report import Report, run_report

__all__ = ["PAGE", "Report", "experiment_report", "recorded_runs", "run_report"]
