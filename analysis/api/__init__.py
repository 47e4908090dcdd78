"""The Python interface: every verb of the command line as a function, and its result with page, plots and tables."""
