"""Who flies trials: a flyer, workers that have one each, how far they are."""
