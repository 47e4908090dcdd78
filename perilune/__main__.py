"""`python -m perilune`: the console command without its script."""

from .analysis.cli import run

run()
