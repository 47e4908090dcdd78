"""Truths of sequencing: what a whole record of inputs implies, or the record that makes a flight written beforehand."""

from tests.support.checks.sequencing import aocs, landing, monitors

TRUTHS = {**aocs.TRUTHS, **landing.TRUTHS, **monitors.TRUTHS}
