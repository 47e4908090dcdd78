"""The figures that a system asks for of its run, drawn."""
