"""Perilune: FMI components, systems and analyses for spacecraft guidance, navigation and control.

The importable face: everything here is defined elsewhere and documented there.
"""

from analysis.api import batch, simulate, stability
from analysis.batch.results import BatchResult
from analysis.cosim.faults import Fault
from analysis.cosim.results import Result
from analysis.errors import InputError
from analysis.stability.bench import StudyError
from analysis.stability.results import StabilityReport
from fmus_src.block import Block, Input, Output, Parameter, State

__all__ = [
    "BatchResult",
    "Block",
    "Fault",
    "Input",
    "InputError",
    "Output",
    "Parameter",
    "Result",
    "StabilityReport",
    "State",
    "StudyError",
    "batch",
    "simulate",
    "stability",
]
