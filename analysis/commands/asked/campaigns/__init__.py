"""The options of the commands about campaigns."""
