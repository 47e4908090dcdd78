"""Code of one name that differs, of which a process has one only."""
