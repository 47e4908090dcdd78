"""What verbs share: text of a flight, requirements, remarks on a system."""
