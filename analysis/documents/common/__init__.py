"""What every page is made of: templates, style, numbers, panels, signals."""
