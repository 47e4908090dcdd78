"""The refusal of what no chart states."""


class UnstatedError(Exception):
    """Axes of matplotlib have something that no chart states; their figure remains a picture."""
