"""Reference pages of the documentation site in Markdown, derived from declarations, parsers and names."""
