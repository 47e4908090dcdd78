"""Campaigns in folders: what they leave, who flies them, long ones."""
