"""TOML files: checked reading, files that extend others, the line of each value."""
