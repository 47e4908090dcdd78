"""Check of free memory before tables with a row for each time step are allocated."""

from __future__ import annotations

import psutil

from ..bounds import MEMORY_FRACTION, ExcessError

SMALL = 1e8  # bytes, up to which the free memory is not queried


def check_table_memory(columns: int, rows: float, step: float, things: str = "signals") -> None:
    """Raise ExcessError, which names the ``step`` (s), if the free memory is too small for a table of ``rows`` rows.

    ``things`` names the columns; one additional column contains the times.
    """
    needed = 8.0 * rows * (columns + 1)
    if needed > SMALL and needed > MEMORY_FRACTION.limit * psutil.virtual_memory().available:
        excess = f"{MEMORY_FRACTION.limit:.0%} of the free memory"
        problem = f"{rows:.10g} rows of {columns} {things} take {needed / 1e9:.3g} GB, over {excess}"
        remedy = f"give a longer step or an earlier stop time, or set {MEMORY_FRACTION.variable}"
        raise ExcessError("`step`", f"{step:g}", problem, remedy)
