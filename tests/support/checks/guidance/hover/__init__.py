"""Truth of hover guidance."""

from tests.support.checks.guidance.hover.flight import hover_guidance

TRUTHS = {"hover_guidance": hover_guidance}
