"""Truths of sequencing: outputs implied by a record of inputs, or inputs that produce a prescribed sequence."""

from tests.support.checks.sequencing import aocs, landing, monitors

TRUTHS = {**aocs.TRUTHS, **landing.TRUTHS, **monitors.TRUTHS}
