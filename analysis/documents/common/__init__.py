"""Elements common to all pages: templates, style, numbers, panels, signals."""
