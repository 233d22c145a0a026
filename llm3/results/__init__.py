"""What the runs of experiments come to: figures with intervals, and tables of them."""

from llm3.results.as_csv import as_csv
from llm3.results.as_markdown import as_markdown
from llm3.results.as_text import as_text
from llm3.results.cells import Cell
from llm3.results.differences import Comparison, Difference
from llm3.results.estimates import Estimate
from llm3.results.means import mean_estimate, mean_estimates
from llm3.results.proportions import paired_share_difference, share_estimate
from llm3.results.report import report
from llm3.results.sign_flips import sign_flip_test
from llm3.results.summary import Summary, summarize
from llm3.results.table import Section, Table

__all__ = [
    "Cell",
    "Comparison",
    "Difference",
    "Estimate",
    "Section",
    "Summary",
    "Table",
    "as_csv",
    "as_markdown",
    "as_text",
    "mean_estimate",
    "mean_estimates",
    "paired_share_difference",
    "report",
    "share_estimate",
    "sign_flip_test",
    "summarize",
]
