"""Checks of blocks: trajectories computed by truths that share no code with the blocks.

The module of each kind of block contains TRUTHS, from FMU names to functions that compute the `Check`. These modules
import nothing from `fmus_src`. `python -m tests.support.checks` writes all checks, `python -m tests.support.checks
NAME` one.
"""
