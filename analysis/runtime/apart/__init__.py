"""Flights in processes of their own: FMUs of others are instantiated there, and never here."""
