"""Pages that tell what happened: one HTML file each, which needs no network."""

from llm3.report.run_report import Report, run_report

__all__ = ["Report", "run_report"]
