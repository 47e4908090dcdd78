"""The elements of a chart's picture: axes, lines, marks and texts at their positions in pt."""
