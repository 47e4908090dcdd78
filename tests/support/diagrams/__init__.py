"""Block diagrams: graphs made by hand, and the geometry of what is drawn."""
