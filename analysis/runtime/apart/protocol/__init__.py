"""What a process, its flight server and the server's children tell each other, and the memory that they share."""
