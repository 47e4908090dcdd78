"""Records of FMPy, by the signal names of Perilune."""

from __future__ import annotations

import numpy as np


def columns(component: str, recorded: np.ndarray) -> dict[str, np.ndarray]:
    """Return the numbers of a record of `fmpy.simulate_fmu` by signal, those of arrays by
    element; Strings are left out."""
    by_name = {}
    for key in recorded.dtype.names or ():
        table = recorded[key]
        if key == "time" or table.dtype.kind not in "biuf":
            continue
        for index in np.ndindex(table.shape[1:]):
            element = f"[{','.join(str(each + 1) for each in index)}]" if index else ""
            by_name[f"{component}.{key}{element}"] = table[(slice(None), *index)].astype(np.float64)
    return by_name
