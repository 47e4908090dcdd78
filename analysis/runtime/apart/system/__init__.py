"""What the operating system is asked of processes; Linux alone has most of it."""
