"""The GUID of a block's native FMU found from its Python FMU: what tells the block from others in either flavour."""

from __future__ import annotations

from ..catalogue import catalogue
from .closure import closure_of
from .native_fmu import native_guid


def guid_of_module(block_name: str, module: str) -> str | None:
    """Return the GUID that the native FMU of a block has, the hash of its C and its description.

    ``module`` is the script of the Python FMU, whose name ends with the hash of its sources: None where they are not
    those of the block of this name here, or the block has no native form.
    """
    block = catalogue().get(block_name)
    if block is None or block.python_only or module != f"{block_name}_{closure_of(block).digest[:16]}":
        return None
    return native_guid(block)
