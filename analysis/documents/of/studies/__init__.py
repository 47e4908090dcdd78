"""Documents of studies that choose the samples of a campaign: rare failure, worst case, sensitivity."""
