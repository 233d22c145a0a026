"""Many runs from one description: read it, run it at any size, and keep a line for each run."""

from llm3.experiments.budgets import Budgets
from llm3.experiments.continuation import setting_differences
from llm3.experiments.experiment import Experiment, Job, Method, ProblemFamily, RunKey
from llm3.experiments.folder import EXPERIMENT_FILE, ExperimentRecord, read_experiment_folder, record_folder
from llm3.experiments.layout import MEASURES, Column, Group, Layout, Published
from llm3.experiments.outlook import MethodOutlook, Share, look_ahead, providers, settled, shares, versions_of
from llm3.experiments.overrides import overridden
from llm3.experiments.run import missing_jobs, run_experiment
from llm3.experiments.run_line import RunLine
from llm3.experiments.toml_file import experiment_of, parse_toml
from llm3.experiments.writer import ExperimentWriter

__all__ = [
    "EXPERIMENT_FILE",
    "MEASURES",
    "Budgets",
    "Column",
    "Experiment",
    "ExperimentRecord",
    "ExperimentWriter",
    "Group",
    "Job",
    "Layout",
    "Method",
    "MethodOutlook",
    "ProblemFamily",
    "Published",
    "RunKey",
    "RunLine",
    "Share",
    "experiment_of",
    "look_ahead",
    "missing_jobs",
    "overridden",
    "parse_toml",
    "providers",
    "read_experiment_folder",
    "record_folder",
    "run_experiment",
    "setting_differences",
    "settled",
    "shares",
    "versions_of",
]
