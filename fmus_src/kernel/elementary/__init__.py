"""Elementary functions in the kernel language: the same bits on every processor.

Published methods in +, -, *, /, sqrt and exact scaling alone, which IEEE 754 defines to the last bit. Errors are below
one unit in the last place (`tests/kernel/test_elementary_errors.py`). Special values are those of C99, Annex F: where
Python's `math` raises, these return infinity or NaN, and never fail themselves; `kernel.functions` raises for them.
Since none divides by zero or leaves a list, their C has no checks.
"""
