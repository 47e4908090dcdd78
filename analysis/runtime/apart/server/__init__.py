"""The flight server and its children, on systems that fork."""
