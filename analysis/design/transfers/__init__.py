"""Transfers between two hovers: simplified programme and its rivals, true optimum and its adjoint system."""
