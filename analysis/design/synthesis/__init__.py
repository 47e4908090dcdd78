"""Synthesis of control laws: network operators as files, formulas and drawings, and the search for them."""
