"""Readable reference implementation of a simulation's steps; every executor must reproduce its results bit for bit."""
