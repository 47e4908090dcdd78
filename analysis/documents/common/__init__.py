"""Common elements of all pages: templates, style, numbers, panels, signals."""
