"""Documents of studies that choose the draws of a campaign: rare failure, worst case, sensitivity."""
