"""Block diagrams: hand-written graphs, and the geometry of their drawings."""
