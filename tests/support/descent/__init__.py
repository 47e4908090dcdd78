"""Descent laws that know the engine, without their code: profiles, turns, steering; and flights of the blocks."""
