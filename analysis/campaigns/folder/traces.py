"""Recorded signals of a variant's trials over time, as one xarray.Dataset."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from ....common.errors import InputError, suggestion
from .campaign_folder import CampaignFolder
from .shard_files import NEW_FOLDER, numbers, read_table

TIME = "time"


def trace_dataset(results: CampaignFolder, variant: str, names: Sequence[str] | None = None) -> Any:
    """Return the traces of a variant: a variable (trial, time) for each signal, with its unit.

    Values are nan after the end of a trial, and at times at which only other trials have a row. Traces of other
    campaigns in the folder are omitted. Raises ImportError without xarray, KeyError for an unknown signal and if there
    are no traces, InputError for a damaged trace.
    """
    if find_spec("xarray") is None:
        raise ImportError("traces needs xarray, which is not installed; pip install 'perilune[notebook]'")
    from xarray import Dataset

    paths = _paths(results, variant)
    if not paths:
        raise KeyError(
            f"no trace of {variant} in {results.folder}; a campaign stores traces if it has a table [record]"
        )
    times = [_columns(path, [TIME])[TIME] for path in paths.values()]
    grid = np.unique(np.concatenate(times))
    known = [name for name in read_table(next(iter(paths.values()))).column_names if name != TIME]
    for name in names or ():
        if name not in known:
            raise KeyError(f"no signal {name}; {suggestion(name, known)}")
    arrays = {name: np.full((len(paths), grid.size), np.nan) for name in (known if names is None else names)}
    for row, (path, time) in enumerate(zip(paths.values(), times, strict=True)):
        places = np.searchsorted(grid, time)
        for name, values in _columns(path, list(arrays)).items():
            arrays[name][row, places] = values
    units = {name: results.provenance["signals"].get(name, {}).get("unit") for name in arrays}
    return Dataset(
        {
            name: (("trial", TIME), values, {"units": units[name]} if units[name] else {})
            for name, values in arrays.items()
        },
        coords={"trial": list(paths), TIME: (TIME, grid, {"units": "s"})},
        attrs={"system": results.provenance["system"], "campaign": results.provenance["campaign"], "variant": variant},
    )


def _paths(results: CampaignFolder, variant: str) -> dict[int, Path]:
    """Return the trace files of the variant's stored trials, by trial."""
    traces = results.traces(variant)
    return {trial: path for trial, path in traces.items() if any(trial in shard.trials for shard in results.shards)}


def _columns(path: Path, names: Sequence[str]) -> dict[str, np.ndarray]:
    table = read_table(path, names)
    for name in names:
        if name not in table.column_names:
            raise InputError(path, name, "no such column", NEW_FOLDER)
    return {name: numbers(table, name, path).astype(np.float64) for name in names}
