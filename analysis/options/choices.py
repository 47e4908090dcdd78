"""Literal types of options with fixed choices, which `get_args` returns in the order of help texts."""

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

SEQUENTIAL: Algorithm = "sequential"  # default of options and systems
FUSED: Flavour = "fused"  # native FMUs with all steps of the system compiled into one function
