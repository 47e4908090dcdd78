"""Navigation: estimates of the vehicle's state for guidance and control, and monitors of their errors."""
