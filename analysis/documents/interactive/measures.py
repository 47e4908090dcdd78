"""Dashes, line widths and text sizes common to charts and matplotlib figures."""

DASHES: tuple[tuple[float, ...], ...] = ((), (5.0, 1.6), (1.2, 1.2), (6.0, 1.6, 1.2, 1.6), (9.0, 2.0))  # line widths
FAILED_DASHES = (4.0, 2.0)  # line widths; of failed simulations and of expected ranges
LINE_WIDTH, AXES_WIDTH, GRID_WIDTH = 1.3, 0.7, 0.6  # pt
LABEL_SIZE, TICK_SIZE = 9.0, 8.0  # pt
WIDTH = 10.4  # in; the page's column
