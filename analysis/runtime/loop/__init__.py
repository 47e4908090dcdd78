"""The loop that simulates a system: its instructions, what it runs on, and its C."""
