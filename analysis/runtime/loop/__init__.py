"""The loop in C: its instructions, what it runs on, the library; elementary functions over arrays."""
