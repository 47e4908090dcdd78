"""Truths of guidance, a module per family."""

from tests.support.checks.guidance import analytic, astar, bank, hover, network, planar_network, rendezvous

MODULES = (analytic, astar, bank, hover, network, planar_network, rendezvous)
TRUTHS = {name: truth for module in MODULES for name, truth in module.TRUTHS.items()}
