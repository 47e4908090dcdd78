"""The reference of the documentation site, as Markdown, derived from declarations, parsers and names."""
