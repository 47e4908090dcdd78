"""Calls of the FMU Manipulation Toolbox."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest


def find_semantic_errors(fmu: Path) -> list[str]:
    """Return what its semantic checks find in an FMU; skip the test where it is not installed."""
    checker = pytest.importorskip("fmu_manipulation_toolbox.checker")
    operations = pytest.importorskip("fmu_manipulation_toolbox.operations")
    logging.getLogger("fmu_manipulation_toolbox").setLevel(logging.ERROR)
    check = checker.OperationSemanticCheck()
    operations.FMU(str(fmu)).apply_operation(check)
    errors: list[str] = check.errors
    return errors
