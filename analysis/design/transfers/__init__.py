"""Transfers between two hover points: simplified programme, alternatives, true optimum and its adjoint system."""
