"""Truths of guidance, one module per family."""

from tests.support.checks.guidance import (
    analytic,
    astar,
    bank,
    convex,
    descent_laws,
    hover,
    jerk_limited,
    network,
    planar_network,
    pointing,
    rendezvous,
    slews,
)

MODULES = (
    analytic,
    astar,
    bank,
    convex,
    descent_laws,
    hover,
    jerk_limited,
    network,
    planar_network,
    pointing,
    rendezvous,
    slews,
)
TRUTHS = {name: truth for module in MODULES for name, truth in module.TRUTHS.items()}
