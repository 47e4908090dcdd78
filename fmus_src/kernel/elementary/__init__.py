"""Elementary functions in the kernel language, with identical bits on every processor.

The published methods use only +, -, *, /, sqrt and exact scaling, which IEEE 754 defines to the last bit. Errors are
below one unit in the last place (`tests/kernel/test_elementary_errors.py`). Special values follow C99, Annex F: where
Python's `math` raises an exception, these functions return infinity or NaN; `kernel.functions` raises instead. They
never divide by zero or index outside a list, so their C code needs no checks.
"""
