"""The font of figures: how wide its text is."""
