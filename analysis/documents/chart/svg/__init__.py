"""SVG of charts: axes, lines, marks and texts at positions in pt."""
