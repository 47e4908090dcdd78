"""What a system is: its files read, checked and made ready to fly."""
