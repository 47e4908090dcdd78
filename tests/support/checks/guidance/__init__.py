"""Truths of guidance, a module per family."""

from tests.support.checks.guidance import bank, rendezvous

TRUTHS = {name: truth for module in (bank, rendezvous) for name, truth in module.TRUTHS.items()}
