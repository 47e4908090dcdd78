"""Control laws as data: files, formulas, drawings."""
