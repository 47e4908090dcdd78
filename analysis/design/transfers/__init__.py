"""Transfers between two hovers: simplified programme and alternatives, true optimum and its adjoint system."""
