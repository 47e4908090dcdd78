"""TOML of campaigns: checked tables, lines of keys, files that extend others."""
