"""What flies for a study: the system at an operating point, excited where it is cut."""
