"""The verbs of design: laws, and plans of least propellant."""
