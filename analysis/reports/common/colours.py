"""Okabe and Ito's colours, which colour-blind readers can tell apart, and those of text and grids."""

BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"
COLOURS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY, "#000000")  # their yellow is too faint on white
HUES = {
    "blue": BLUE,
    "vermilion": VERMILION,
    "green": GREEN,
    "purple": PURPLE,
    "orange": ORANGE,
    "sky": SKY,
}  # by the names that declarations use
INK, FAINT, GRID = "#222222", "#6b6b6b", "#dddddd"
