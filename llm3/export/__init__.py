"""Hands a plan over to a robot: trajectories and gripper events in order, in files that others read."""

from llm3.export.formats import FORMATS, read_program, write_program
from llm3.export.limits import check_program
from llm3.export.of_plan import plan_with, program_of
from llm3.export.program import Deed, Move, Program
from llm3.export.resampling import resampled

__all__ = [
    "FORMATS",
    "Deed",
    "Move",
    "Program",
    "check_program",
    "plan_with",
    "program_of",
    "read_program",
    "resampled",
    "write_program",
]
