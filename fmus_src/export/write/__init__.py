"""Generation of C99 from an analysed kernel, statement by statement, with results identical to Python's in all bits."""
