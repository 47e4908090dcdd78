"""Code shared by verbs: arguments, requirements, texts, plans of campaigns, results with documents."""
