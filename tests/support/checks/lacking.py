"""Blocks that lack a check; the list may only shrink."""

LACKING = ("astar_guidance", "astar_modified_guidance", "astar_robust_guidance", "hover_guidance")
