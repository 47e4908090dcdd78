"""How much the long checks do: all of it under `make long`, a part of it under `make test`."""

import os
from typing import TypeVar

LONG = os.environ.get("PERILUNE_LONG") == "1"
Value = TypeVar("Value")


def either(long: Value, short: Value) -> Value:
    """``long`` under `make long`, else ``short``."""
    return long if LONG else short
