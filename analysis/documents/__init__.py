"""Documents of results: sections of text, tables and figures, composed once and rendered for every medium."""
