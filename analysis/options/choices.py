"""Choices of options: types for annotations, whose `get_args` are the names in the order of help texts."""

from __future__ import annotations

from typing import Literal

from ...common.paths import Build

Algorithm = Literal["sequential", "jacobi"]
Flavour = Literal[Build, "fused"]
OpenInputs = Literal["refuse", "start"]
Isolation = Literal["available", "strict"]
Engine = Literal["threads", "processes"]
LogLevel = Literal["error", "warning", "info", "all"]
MarginKind = Literal["disk", "modulus", "gain", "phase", "delay"]

SEQUENTIAL: Algorithm = "sequential"  # where neither option nor system states another
FUSED: Flavour = "fused"  # of native FMUs, the steps of the system compiled as one function
