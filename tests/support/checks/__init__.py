"""Checks of blocks: trajectories computed by truths that share no line with the blocks.

A module per kind of block has TRUTHS, FMU name -> function that computes the `Check`. They import nothing of
`fmus_src`. `python -m tests.support.checks` writes all, `python -m tests.support.checks NAME` one.
"""
