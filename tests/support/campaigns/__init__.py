"""Campaigns in folders: files, processes that simulate them, campaigns with many trials."""
