"""A campaign's folder as analysts read it: lazily, complete or while the campaign is running."""
