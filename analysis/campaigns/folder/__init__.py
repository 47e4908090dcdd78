"""Folder of a campaign as analysts read it: on demand, complete or while the campaign is running."""
