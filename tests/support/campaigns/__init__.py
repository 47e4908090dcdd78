"""Campaigns in folders: their files, the processes that simulate them, long ones."""
