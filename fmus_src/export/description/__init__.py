"""What an FMU says of itself: its XML documents, by version of FMI."""
