"""Error of a drawing that charts do not support."""


class UnstatedError(Exception):
    """Axes of matplotlib have something that no chart states; their figure remains a picture."""
