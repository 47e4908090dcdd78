"""What figures a system asks for: its annotation, read into plain values."""
