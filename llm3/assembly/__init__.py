"""From the names that a user gives to a run that is ready to start."""

from llm3.assembly.choices import choose_instance, choose_options, choose_timer, given_skeleton
from llm3.assembly.config import UNTIMED, USUAL_TIMER, RunConfig
from llm3.assembly.prepared import Prepared, assemble, prepare
from llm3.assembly.problem import Problem, open_problem
from llm3.assembly.run import Run
from llm3.assembly.solvers import Loop, Search, Solver

__all__ = [
    "UNTIMED",
    "USUAL_TIMER",
    "Loop",
    "Prepared",
    "Problem",
    "Run",
    "RunConfig",
    "Search",
    "Solver",
    "assemble",
    "choose_instance",
    "choose_options",
    "choose_timer",
    "given_skeleton",
    "open_problem",
    "prepare",
]
