"""Figures of papers, drawn from Perilune's simulations."""
