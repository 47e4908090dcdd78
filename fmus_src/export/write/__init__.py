"""A judged kernel written as C99, statement by statement, with the bits that Python gives."""
