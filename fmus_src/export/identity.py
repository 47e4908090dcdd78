"""GUID of a block's native FMU, derived from its Python FMU to identify the block in both flavours."""

from __future__ import annotations

from ..catalogue import catalogue
from .closure import closure_of
from .native_fmu import native_guid


def guid_of_module(block_name: str, module: str) -> str | None:
    """Return the GUID of a block's native FMU, a hash of its C and its description.

    ``module`` is the name of the script of the Python FMU, which ends with the hash of its sources. Returns None if
    these sources differ from the present block of this name, or if the block has no native form.
    """
    block = catalogue().get(block_name)
    if block is None or block.python_only or module != f"{block_name}_{closure_of(block).digest[:16]}":
        return None
    return native_guid(block)
