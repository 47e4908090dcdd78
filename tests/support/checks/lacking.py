"""Blocks that lack a check; the list may only shrink."""

LACKING = ("hover_guidance",)
