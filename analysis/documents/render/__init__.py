"""Renderers of documents: terminal, notebook, HTML."""
