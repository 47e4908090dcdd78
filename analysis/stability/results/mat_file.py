"""MATLAB files of version 5 whose bytes depend on their content alone.

Source: The MathWorks, MAT-File Format: the first 116 bytes are a text that begins with "MATLAB 5.0 MAT-file", then come
the subsystem's offset, the version and the mark of the byte order. SciPy writes date and platform into that text.
"""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from scipy.io import savemat

HEADER = b"MATLAB 5.0 MAT-file, written by Perilune".ljust(116)


def mat_bytes(variables: Mapping[str, Any]) -> bytes:
    """The file with these variables; names are at most 63 letters, digits and underscores."""
    file = io.BytesIO()
    savemat(file, dict(variables), long_field_names=True, oned_as="column")
    return HEADER + file.getvalue()[len(HEADER) :]


def struct_array(records: Sequence[Mapping[str, Any]]) -> np.ndarray:
    """Records with the same keys as a MATLAB struct array, one by n; lists of texts are cell arrays."""
    names = list(records[0]) if records else []
    array = np.empty((1, len(records)), dtype=[(name, object) for name in names])
    for place, record in enumerate(records):
        for name, value in record.items():
            array[name][0, place] = _cells(value) if isinstance(value, list) else value
    return array


def _cells(texts: Sequence[str]) -> np.ndarray:
    cells = np.empty((len(texts), 1), dtype=object)
    cells[:, 0] = texts
    return cells
