"""What verbs share: options, requirements, targets, tables of text."""
